//! Keys that came and have not been obeyed yet, and replies: a bounded number, and a Ctrl-C that waits for few of them.

use std::{
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicBool, AtomicUsize, Ordering},
    },
    time::Instant,
};

use super::{
    event::{Event, Post},
    reply::Reply,
};
use crate::app::{Gesture, Input, Key, Mouse};

/// Most keys and pastes that wait; a user does not type as far ahead.
const MOST: usize = 256;

/// Most inputs that wait while Ctrl-C is obeyed in its turn, as many as a hand types ahead: what was typed before it
/// decides what it closes.
const AHEAD: usize = 32;

const INTERRUPT: Input = Input::Key(Key::ctrl('c'));

/// Waiting inputs from which on those of the mouse are left out.
const MOST_MOTION: usize = MOST / 4;

/// Most replies that wait; as many are never asked for.
const MOST_REPLIES: usize = 64;

/// What both ends share.
#[derive(Default)]
struct Shared {
    waiting: AtomicUsize,
    left_out: AtomicUsize,
    /// Whether a Ctrl-C waits for its turn.
    interrupting: AtomicBool,
    /// Whether a Ctrl-C came that waits for nothing.
    interrupted: AtomicBool,
    replies: Mutex<Vec<(Reply, Instant)>>,
}

/// The end of the backlog that the thread which reads the terminal has.
pub(super) struct Entrance {
    shared: Arc<Shared>,
    post: Post,
}

/// The end of the backlog that the thread which obeys has.
pub(super) struct Backlog(Arc<Shared>);

/// A backlog whose entrance posts an event for each input.
pub(super) fn backlog(post: Post) -> (Entrance, Backlog) {
    let shared = Arc::new(Shared::default());
    (Entrance { shared: Arc::clone(&shared), post }, Backlog(shared))
}

impl Entrance {
    /// Takes an input in, or leaves it out if too many wait; a Ctrl-C is never left out, and waits neither for many nor
    /// for another one.
    pub(super) fn take(&self, input: Input) {
        if input == INTERRUPT {
            let few = self.shared.waiting.load(Ordering::Acquire) <= AHEAD;
            if few && !self.shared.interrupting.swap(true, Ordering::AcqRel) {
                self.shared.waiting.fetch_add(1, Ordering::AcqRel);
                self.post.send(Event::Typed(input));
            } else if !self.shared.interrupted.swap(true, Ordering::AcqRel) {
                self.post.send(Event::Interrupted);
            }
            return;
        }
        // Some of the places that the mouse has passed may be missed, and that is nothing to be told of; but a key must
        // find room behind them.
        let typed = !matches!(input, Input::Mouse(Mouse { gesture, .. }) if gesture != Gesture::Release);
        let most = if typed { MOST } else { MOST_MOTION };
        if self.shared.waiting.fetch_add(1, Ordering::AcqRel) < most {
            self.post.send(Event::Typed(input));
        } else {
            self.shared.waiting.fetch_sub(1, Ordering::AcqRel);
            self.shared.left_out.fetch_add(usize::from(typed), Ordering::AcqRel);
        }
    }

    /// Takes in a reply that came just now, or leaves it out if too many wait.
    pub(super) fn replied(&self, reply: Reply) {
        let mut replies = self.shared.replies.lock().unwrap_or_else(PoisonError::into_inner);
        if replies.len() < MOST_REPLIES {
            replies.push((reply, Instant::now()));
        }
        if replies.len() == 1 {
            self.post.send(Event::Replied);
        }
    }

    /// The way to the thread that obeys.
    pub(super) fn post(&self) -> &Post {
        &self.post
    }
}

impl Backlog {
    /// Whether a Ctrl-C came that ends the program before anything else is obeyed: to ask before each event.
    pub(super) fn interrupted(&self) -> bool {
        self.0.interrupted.load(Ordering::Acquire)
    }

    /// The replies that came since this was last asked, each with its moment.
    pub(super) fn replies(&self) -> Vec<(Reply, Instant)> {
        std::mem::take(&mut *self.0.replies.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Notes that an input is obeyed now. How many were left out since none waited, if it was the last one; else 0.
    pub(super) fn obeyed(&self, input: &Input) -> usize {
        if *input == INTERRUPT {
            self.0.interrupting.store(false, Ordering::Release);
        }
        match self.0.waiting.fetch_sub(1, Ordering::AcqRel) {
            1 => self.0.left_out.swap(0, Ordering::AcqRel),
            _ => 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc;

    #[test]
    fn a_million_keys_are_bounded_and_ctrl_c_waits_for_none_of_them() {
        let (sender, events) = mpsc::channel();
        let (entrance, backlog) = backlog(Post(sender));
        for _ in 0..1_000_000 {
            entrance.take(Input::Key(Key::char(']')));
        }
        assert!(!backlog.interrupted());
        for _ in 0..1_000_000 {
            entrance.take(INTERRUPT);
        }
        assert!(backlog.interrupted(), "before a single one was obeyed");
        let waiting: Vec<Event> = events.try_iter().collect();
        assert_eq!(waiting.len(), MOST + 1);
        assert!(matches!(waiting.last(), Some(Event::Interrupted)));
        let left_out: Vec<usize> = (0..MOST).map(|_| backlog.obeyed(&Input::News)).collect();
        assert_eq!(left_out[..MOST - 1], [0; MOST - 1]);
        assert_eq!(left_out[MOST - 1], 1_000_000 - MOST, "said when there is quiet");
        entrance.take(Input::Key(Key::char('?')));
        assert!(matches!(events.try_recv(), Ok(Event::Typed(_))), "there is room again");
        assert_eq!(backlog.obeyed(&Input::News), 0);
    }

    #[test]
    fn ctrl_c_takes_its_turn_after_what_a_hand_types_ahead_but_a_second_one_does_not() {
        let (sender, events) = mpsc::channel();
        let (entrance, backlog) = backlog(Post(sender));
        for _ in 0..2 {
            for c in ":dt 1".chars() {
                entrance.take(Input::Key(Key::char(c)));
            }
            entrance.take(INTERRUPT);
            assert!(!backlog.interrupted());
            let waiting: Vec<Event> = events.try_iter().collect();
            assert!(matches!(waiting[5], Event::Typed(INTERRUPT)) && waiting.len() == 6, "{waiting:?}");
            for event in waiting {
                let Event::Typed(input) = event else { panic!("{event:?}") };
                assert_eq!(backlog.obeyed(&input), 0);
            }
        }
        entrance.take(INTERRUPT);
        assert!(!backlog.interrupted());
        entrance.take(INTERRUPT);
        assert!(backlog.interrupted());
    }

    #[test]
    fn a_million_places_of_the_mouse_leave_room_for_keys_and_are_not_told_of() {
        let (sender, events) = mpsc::channel();
        let (entrance, backlog) = backlog(Post(sender));
        for column in 0..1_000_000 {
            entrance.take(Input::Mouse(Mouse { gesture: Gesture::Drag, column: column as u16, row: 0 }));
        }
        entrance.take(Input::Mouse(Mouse { gesture: Gesture::Release, column: 0, row: 0 }));
        entrance.take(Input::Key(Key::char('?')));
        let waiting = events.try_iter().count();
        assert_eq!(waiting, MOST_MOTION + 2);
        assert_eq!((0..waiting).map(|_| backlog.obeyed(&Input::News)).sum::<usize>(), 0);
    }

    #[test]
    fn a_million_replies_are_bounded_and_told_of_once() {
        let (sender, events) = mpsc::channel();
        let (entrance, backlog) = backlog(Post(sender));
        for round in 0..2 {
            for _ in 0..1_000_000 {
                entrance.replied(Reply::Attributes);
            }
            assert_eq!(events.try_iter().count(), 1, "round {round}");
            assert_eq!(backlog.replies().len(), MOST_REPLIES);
            assert_eq!(backlog.replies(), []);
        }
    }
}
