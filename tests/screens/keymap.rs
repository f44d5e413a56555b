//! Do keys that the user has bound otherwise work, and does every text name them?

use carom::app::{Action, Code, Effect, Key, Keymap};

use crate::app::User;

#[test]
fn rebound_keys_work_and_every_text_names_them_as_bound() {
    let mut keymap = Keymap::default();
    for (action, key) in [
        (Action::Step, Key::char('y')),
        (Action::Help, Key::plain(Code::F(2))),
        (Action::Scenes, Key::char('O')),
        (Action::NextMethod, Key::char('M')),
        (Action::Restart, Key::char('!')),
        (Action::Quit, Key::char('Q')),
    ] {
        keymap.bind(action, &[key]);
    }
    let mut user = User::bound("paper-0", true, keymap);
    assert!(user.row(-1).contains("y step") && user.row(-1).contains("F2 help"), "{}", user.row(-1));
    let _ = user.press(Key::char('.'));
    assert_eq!(user.snapshot().t, 0.0, "the key of the table does nothing any more");
    let _ = user.press(Key::char('y'));
    assert_eq!(user.snapshot().t, 0.01);
    let _ = user.press(Key::plain(Code::F(2)));
    assert!(user.text().contains("y") && !user.text().contains(". n Right"), "{}", user.text());
    let _ = user.press(Key::plain(Code::F(2)));
    let _ = user.press(Key::char('O'));
    assert!(user.text().contains("/ filters"), "{}", user.text());
    let _ = user.press(Key::char('O'));
    assert!(!user.text().contains("/ filters"), "the same key closes it: {}", user.text());
    assert_eq!(user.press(Key::char('q')), Effect::DrawNow);
    assert_eq!(user.press(Key::char('Q')), Effect::Quit);
    assert_eq!(user.press(Key::ctrl('c')), Effect::Quit);
}
