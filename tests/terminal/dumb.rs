//! Can a run be led on a terminal that shows nothing but lines?

use crate::pty::{Start, carom};

#[test]
fn a_typed_line_stops_the_telling_and_from_then_on_lines_are_keys() {
    let mut pty = Start { environment: &[("TERM", "dumb")], ..carom(&["box-gas"]) }.run();
    pty.until_text("hits");
    pty.send("\r");
    pty.until_text("Each line is keys");
    pty.send("c\r");
    pty.until_text("impact at");
    pty.send("q\r");
    assert_eq!(pty.exit(), 0);
    assert!(!pty.output.contains(&0x1b), "{}", pty.text());
}

#[test]
fn typed_at_the_telling_q_quits_and_ctrl_c_interrupts() {
    for (typed, code) in [("q\r", 0), ("\x03", 130)] {
        let mut pty = carom(&["--text", "box-gas"]).run();
        pty.until_text("hits");
        pty.send(typed);
        assert_eq!(pty.exit(), code, "{typed:?}");
    }
}
