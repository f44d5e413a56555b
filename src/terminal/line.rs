//! How many pictures may be under way to the terminal.
//!
//! The system, sshd, the network and the ssh client take half a megabyte of pictures before a write ever waits: only a
//! reply of the terminal says that a picture has been seen. So each picture ends with a request, and few pictures are
//! unanswered at any time: as many as the round trip needs for a smooth run, and one as soon as it grows longer, which
//! means that pictures queue. An answer to a key may be one more.

use std::{collections::VecDeque, time::Duration};

/// A terminal that has not answered its first request for this long, and for each byte of its first picture so long as
/// 64 kbit/s need for it, is taken for one that never does.
const FIRST: Duration = Duration::from_secs(1);
const FIRST_BYTE: Duration = Duration::from_micros(125);

/// Without an answer for this long, beyond what is usual, the line is silent.
const SILENCE: Duration = Duration::from_secs(2);

/// Without an answer for this long, a key is a sign that answers were lost: it could not come over a dead line.
const LOST: Duration = Duration::from_secs(10);

/// Losses in a row after which the terminal counts as one that does not answer any more.
const LOSSES: u32 = 3;

/// After a silence, answers to what was sent before it may come for this long.
const SETTLED: Duration = Duration::from_millis(500);

/// Shortest time between two pictures for a terminal that does not answer.
pub(super) const BLIND: Duration = Duration::from_millis(100);

/// Pictures per second that the window makes room for; more than are shown smoothly would only be under way for nothing
/// when the line falls silent.
const RATE: u32 = 25;

/// Widest window, pictures.
const WIDEST: u32 = 4;
/// Widest window on a thin line, pictures.
const WIDEST_THIN: u32 = 2;
/// A line that a thousand bytes keep busy for longer than this is thin.
const THIN: Duration = Duration::from_millis(5);

/// A picture that keeps the line busy for longer than this makes the answer to a key wait long.
const LONG: Duration = Duration::from_millis(250);

/// Pictures in a row that tell how long a byte takes; the quickest counts: a busy machine is no thin line, and what had to
/// wait for other pictures tells nothing.
const SAMPLES: usize = 8;

/// Smallest picture that tells how long a byte takes, bytes.
const TELLING: usize = 500;

/// What is known of the terminal's answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Answers {
    /// The terminal was not asked yet, or just now.
    Unknown,
    Come,
    Fail,
}

/// A request under way.
#[derive(Debug, Clone, Copy)]
struct Request {
    sent: Duration,
    /// Bytes of the picture before it; `None`: it went out alone.
    picture: Option<usize>,
}

/// The line to the terminal.
#[derive(Debug)]
pub(super) struct Line {
    answers: Answers,
    unanswered: VecDeque<Request>,
    /// Most pictures that may be unanswered.
    window: u32,
    /// Shortest round trip since the last silence, begun by that of a request alone: a picture keeps a thin line busy.
    shortest: Option<Duration>,
    /// Last round trip that was no silence.
    usual: Duration,
    /// Round trip and bytes of the last pictures.
    samples: VecDeque<(Duration, usize)>,
    /// Bytes of the last picture.
    last: usize,
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
            samples: VecDeque::new(),
            last: 0,
            waiting: None,
            returned: None,
            losses: 0,
        }
    }

    /// Whether a request alone should go out now, which measures the round trip of a line that carries nothing else.
    /// Sent just before a picture it would not: ssh hands on in one piece what it has read in one.
    pub(super) fn wants_probe(&self, now: Duration) -> bool {
        self.answers == Answers::Come && self.shortest.is_none() && self.unanswered.is_empty() && self.is_settled(now)
    }

    /// Notes that a request goes out alone.
    pub(super) fn probing(&mut self, now: Duration) {
        self.ask(now, None);
    }

    /// Notes that a picture of `bytes` goes out; whether a request goes with it. A terminal that does not answer is asked
    /// now and then.
    pub(super) fn sending(&mut self, now: Duration, bytes: usize) -> bool {
        self.last = bytes;
        if self.answers == Answers::Fail {
            if self.unanswered.back().is_some_and(|request| request.sent + LOST > now) {
                return false;
            }
            self.unanswered.clear(); // what is older is lost
        }
        self.ask(now, Some(bytes));
        true
    }

    fn ask(&mut self, now: Duration, picture: Option<usize>) {
        self.waiting.get_or_insert(now);
        self.unanswered.push_back(Request { sent: now, picture });
    }

    /// Notes that the oldest request has been answered; how long the line was silent before, if it was.
    pub(super) fn replied(&mut self, now: Duration) -> Option<Duration> {
        let request = self.unanswered.pop_front()?; // none: nothing was asked
        let first = std::mem::replace(&mut self.answers, Answers::Come) != Answers::Come;
        self.losses = 0;
        let waited = self.waiting.map_or(Duration::ZERO, |since| now.saturating_sub(since));
        self.waiting = self.unanswered.front().map(|_| now);
        if !first && waited > SILENCE + 2 * self.usual {
            (self.shortest, self.window, self.returned) = (None, 1, Some(now));
            self.samples.clear();
            return Some(waited);
        }
        if self.is_settled(request.sent) {
            self.usual = now.saturating_sub(request.sent).min(LOST);
            self.measure(request, self.usual);
        }
        None
    }

    /// Whether what was sent at `sent` is surely no remainder of a silence.
    fn is_settled(&self, sent: Duration) -> bool {
        self.returned.is_none_or(|returned| sent >= returned + SETTLED)
    }

    /// Sets the window by the round trip of a request.
    fn measure(&mut self, request: Request, trip: Duration) {
        if let Some(bytes) = request.picture.filter(|bytes| *bytes >= TELLING) {
            self.samples.push_back((trip, bytes));
            if self.samples.len() > SAMPLES {
                self.samples.pop_front();
            }
        }
        let shortest = match (self.shortest, request.picture) {
            (Some(shortest), _) => shortest.min(trip),
            (None, None) => trip,
            (None, Some(_)) => return,
        };
        self.shortest = Some(shortest);
        if request.picture.is_none() {
            return;
        }
        let widest = if self.busy(1000).is_some_and(|busy| busy > THIN) { WIDEST_THIN } else { WIDEST };
        let most = (shortest * RATE).as_millis().div_ceil(1000).clamp(1, widest.into()) as u32;
        if trip > shortest * 3 / 2 + Duration::from_millis(20) {
            self.window = 1;
        } else if trip <= shortest * 5 / 4 + Duration::from_millis(10) {
            self.window += 1;
        }
        self.window = self.window.min(most);
    }

    /// How long so many bytes keep the line busy, as far as that is known.
    fn busy(&self, bytes: usize) -> Option<Duration> {
        let shortest = self.shortest?;
        let per_byte = |(trip, bytes): &(Duration, usize)| trip.saturating_sub(shortest).as_secs_f64() / *bytes as f64;
        let quickest = self.samples.iter().map(per_byte).min_by(f64::total_cmp)?;
        Some(Duration::from_secs_f64(quickest * bytes as f64))
    }

    /// Whether one more picture may go out; `urgent`: it answers a key, so that it waits for no measurement either.
    pub(super) fn has_room(&self, urgent: bool) -> bool {
        if self.answers == Answers::Fail {
            return true;
        }
        let pictures = self.unanswered.iter().filter_map(|request| request.picture);
        let (count, bytes) = pictures.fold((0, 0), |(count, sum), bytes| (count + 1, sum + bytes));
        let measuring = count < self.unanswered.len();
        // On a line that is half full already, a second picture would only wait in it.
        let half = || self.busy(bytes).zip(self.shortest).is_some_and(|(busy, shortest)| busy * 2 <= shortest);
        let room = !measuring && (count == 0 || count < self.window as usize && half());
        room || urgent && count <= self.window as usize
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
        first.map(|request| request.sent + FIRST + FIRST_BYTE * request.picture.unwrap_or_default().min(100_000) as u32)
    }

    /// Notes that a key has come.
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

    /// Lets go of the requests under way: their answers have gone to another program that read the terminal meanwhile.
    pub(super) fn forget(&mut self) {
        self.unanswered.clear();
        self.waiting = None;
    }

    /// Shortest time between two pictures. A line that a picture keeps busy is left alone for as long again, so that the
    /// answer to a key, which may come at any moment, finds it free as often as not; and for half as long again where it
    /// would have to wait long.
    pub(super) fn interval(&self) -> Duration {
        match self.answers {
            Answers::Fail => BLIND,
            _ => {
                let busy = self.busy(self.last).unwrap_or_default();
                busy * 2 + if busy > LONG { busy / 2 } else { Duration::ZERO }
            }
        }
    }

    /// How long answers under way are worth waiting for; `None`: there are none.
    pub(super) fn answers_within(&self) -> Option<Duration> {
        let awaited = self.answers != Answers::Fail && !self.unanswered.is_empty();
        awaited.then_some(self.usual * 2 + SETTLED)
    }
}
