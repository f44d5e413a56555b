//! Reads the terminal on a thread of its own: bytes in, keys out. It reads as fast as bytes come, whatever becomes of
//! the keys, so that a Ctrl-C never waits behind others in the terminal.

use std::{fs::File, io, os::fd::AsFd, thread, time::Duration};

use rustix::{
    event::{PollFd, PollFlags, Timespec, poll},
    io::Errno,
    termios::isatty,
};

use super::{backlog::Entrance, decoder::Decoder, event::Event};

/// Starts the thread; it posts inputs, and [`Event::Gone`] when the terminal is.
///
/// # Errors
/// If neither standard input nor the controlling terminal can be read, or there is no thread to be had.
pub(super) fn start(escape_time: Duration, entrance: Entrance) -> io::Result<()> {
    let stdin = io::stdin();
    let tty = if isatty(&stdin) { File::from(stdin.as_fd().try_clone_to_owned()?) } else { File::open("/dev/tty")? };
    let decoder = Decoder::new(escape_time);
    thread::Builder::new().name("terminal input".into()).spawn(move || {
        read(&tty, decoder, &entrance);
        entrance.post().send(Event::Gone);
    })?;
    Ok(())
}

/// Reads the terminal until it is gone.
fn read(tty: &File, mut decoder: Decoder, entrance: &Entrance) {
    let mut bytes = [0; 4096];
    loop {
        let waiting = decoder.patience().map(|time| Timespec::try_from(time).expect("it is seconds at most"));
        let mut ready = [PollFd::new(tty, PollFlags::IN)];
        match poll(&mut ready, waiting.as_ref()) {
            Ok(0) => decoder.silence(),
            Ok(_) if ready[0].revents().contains(PollFlags::IN) => match rustix::io::read(tty, &mut bytes) {
                Ok(0) => return,
                Ok(n) => decoder.feed(&bytes[..n]),
                Err(Errno::INTR | Errno::AGAIN) => {}
                Err(_) => return,
            },
            Err(Errno::INTR) => {}
            _ => return, // hung up
        }
        for reply in decoder.replies.drain(..) {
            entrance.replied(reply); // first: a key may be obeyed better when they are known
        }
        for input in decoder.inputs.drain(..) {
            entrance.take(input);
        }
    }
}
