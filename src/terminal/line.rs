//! How many pictures may be under way to the terminal.
//!
//! The system, sshd, the network and the ssh client take half a megabyte of pictures before a write ever waits: only a
//! reply of the terminal says that a picture has been seen. So each picture ends with a request, and few pictures are
//! unanswered at any time: as many as the round trip needs for a smooth run, and one as soon as it grows longer, which
//! means that pictures queue. An answer to a key may be one more.

use std::{collections::VecDeque, time::Duration};

/// A terminal that has not answered its first request for this long is taken for one that never does.
const FIRST: Duration = Duration::from_secs(1);

/// Without an answer for this long, beyond what is usual, the line is silent.
const SILENCE: Duration = Duration::from_secs(2);

/// Without an answer for this long, a key is a sign that answers were lost: it could not come over a dead line.
const LOST: Duration = Duration::from_secs(10);

/// So many losses in a row, and the terminal counts as one that does not answer any more.
const LOSSES: u32 = 3;

/// After a silence, answers to what was sent before it may come for this long.
const SETTLED: Duration = Duration::from_millis(500);

/// Shortest time between two pictures for a terminal that does not answer.
pub(super) const BLIND: Duration = Duration::from_millis(100);

/// Pictures per second that the window makes room for; more than are shown smoothly would only be under way for nothing
/// when the line falls silent.
const RATE: u32 = 25;

/// Widest window.
const WIDEST: u32 = 4;

/// What is known of the terminal's answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Answers {
    /// It was not asked yet, or just now.
    Unknown,
    Come,
    Fail,
}

/// A request under way.
#[derive(Debug, Clone, Copy)]
struct Request {
    sent: Duration,
    /// Whether a picture came with it.
    picture: bool,
    /// Whether the line carried nothing when it was sent.
    alone: bool,
}

/// The requests that go with a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Requests {
    /// Before it: measures the round trip of a line that carries nothing.
    pub(super) before: bool,
    /// After it: tells when it has been seen.
    pub(super) after: bool,
}

/// The line to the terminal.
#[derive(Debug)]
pub(super) struct Line {
    answers: Answers,
    unanswered: VecDeque<Request>,
    /// Most unanswered pictures.
    window: u32,
    /// Shortest round trip since the last silence.
    shortest: Option<Duration>,
    /// Last round trip that was no silence.
    usual: Duration,
    /// How long the line last was busy with one picture.
    busy: Duration,
    /// Since when an answer is awaited.
    waiting: Option<Duration>,
    /// When the last silence ended.
    returned: Option<Duration>,
    losses: u32,
}

impl Line {
    pub(super) fn new() -> Line {
        Line {
            answers: Answers::Unknown,
            unanswered: VecDeque::new(),
            window: 1,
            shortest: None,
            usual: Duration::ZERO,
            busy: Duration::ZERO,
            waiting: None,
            returned: None,
            losses: 0,
        }
    }

    /// What should go with a picture that is sent now. A terminal that does not answer is asked now and then.
    pub(super) fn requests(&self, now: Duration) -> Requests {
        let alone = self.unanswered.is_empty();
        let fails = self.answers == Answers::Fail;
        let before = self.shortest.is_none() && alone && self.is_settled(now) && !fails;
        Requests { before, after: !fails || self.unanswered.back().is_none_or(|request| request.sent + LOST <= now) }
    }

    /// A picture goes out with these requests.
    pub(super) fn sending(&mut self, now: Duration, requests: Requests) {
        let alone = self.unanswered.is_empty();
        if requests.before {
            self.unanswered.push_back(Request { sent: now, picture: false, alone });
        }
        if requests.after {
            if self.answers == Answers::Fail {
                self.unanswered.clear(); // what is older is lost
            }
            self.waiting.get_or_insert(now);
            self.unanswered.push_back(Request { sent: now, picture: true, alone });
        }
    }

    /// The oldest request has been answered; how long the line was silent before, if it was.
    pub(super) fn replied(&mut self, now: Duration) -> Option<Duration> {
        let request = self.unanswered.pop_front()?; // none: nobody asked
        let first = std::mem::replace(&mut self.answers, Answers::Come) != Answers::Come;
        self.losses = 0;
        let waited = self.waiting.map_or(Duration::ZERO, |since| now.saturating_sub(since));
        self.waiting = self.unanswered.front().map(|_| now);
        if !first && waited > SILENCE + 2 * self.usual {
            (self.shortest, self.window, self.returned, self.busy) = (None, 1, Some(now), Duration::ZERO);
            return Some(waited);
        }
        if self.is_settled(request.sent) {
            self.usual = now.saturating_sub(request.sent).min(LOST);
            self.measure(request, self.usual);
        }
        None
    }

    /// Whether what was sent then is surely no remainder of a silence.
    fn is_settled(&self, sent: Duration) -> bool {
        self.returned.is_none_or(|returned| sent >= returned + SETTLED)
    }

    /// Sets the window by the round trip of a request.
    fn measure(&mut self, request: Request, trip: Duration) {
        let shortest = self.shortest.map_or(trip, |shortest| shortest.min(trip));
        self.shortest = Some(shortest);
        if !request.picture {
            return;
        }
        if request.alone {
            self.busy = trip - shortest;
        }
        let most = (shortest * RATE).as_millis().div_ceil(1000).clamp(1, WIDEST.into()) as u32;
        if trip > shortest * 3 / 2 + Duration::from_millis(20) {
            self.window = 1;
        } else if trip <= shortest * 5 / 4 + Duration::from_millis(10) {
            self.window = (self.window + 1).min(most);
        }
    }

    /// Whether one more picture may go out; `urgent`: it answers a key.
    pub(super) fn has_room(&self, urgent: bool) -> bool {
        let pictures = self.unanswered.iter().filter(|request| request.picture).count();
        self.answers == Answers::Fail || pictures < self.window as usize + usize::from(urgent)
    }

    /// Takes note of the time.
    pub(super) fn tick(&mut self, now: Duration) {
        if self.gives_up_at().is_some_and(|at| at <= now) {
            self.answers = Answers::Fail;
        }
    }

    /// When the terminal will be taken for one that does not answer, unless it does.
    pub(super) fn gives_up_at(&self) -> Option<Duration> {
        let first = self.unanswered.front().filter(|_| self.answers == Answers::Unknown);
        first.map(|request| request.sent + FIRST)
    }

    /// A key has come.
    pub(super) fn pressed(&mut self, now: Duration) {
        let lost = self.unanswered.back().is_some_and(|request| request.sent + LOST <= now);
        if self.answers == Answers::Come && lost {
            self.unanswered.clear();
            self.losses += 1;
            if self.losses >= LOSSES {
                self.answers = Answers::Fail;
            }
        }
    }

    /// Answers under way will not reach us: somebody else has read the terminal meanwhile.
    pub(super) fn forget(&mut self) {
        self.unanswered.clear();
        self.waiting = None;
    }

    /// Shortest time between two pictures. A line that a picture keeps busy is left alone for longer than that, so that
    /// the answer to a key, which may come at any moment, mostly finds it free.
    pub(super) fn interval(&self) -> Duration {
        match self.answers {
            Answers::Fail => BLIND,
            _ => self.busy * 5 / 2,
        }
    }

    /// Until when answers under way are worth waiting for.
    pub(super) fn all_answered_by(&self) -> Option<Duration> {
        let last = self.unanswered.back().filter(|_| self.answers != Answers::Fail)?;
        Some(last.sent + self.usual * 2 + SETTLED)
    }
}
