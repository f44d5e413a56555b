//! When the next picture is drawn: only if something changed, only if the line has room for it, and not too often.
//! Moments are given as times since any fixed start.

use std::time::Duration;

use super::{budget::Budget, line::Line};

/// A window that is being dragged settles for this long before it is drawn again.
const SETTLE: Duration = Duration::from_millis(30);

/// Sizes that come sooner after each other are those of a drag, which is slow to settle: a hand pauses.
const DRAG: Duration = Duration::from_millis(500);
const SETTLE_DRAG: Duration = Duration::from_millis(120);

/// A window that never settles is drawn this often: each time it is a whole picture, and a drag has many sizes.
const UNSETTLED: Duration = Duration::from_millis(1000);

/// The simulation's answer to a key is awaited for this long before a picture without it is drawn.
const ANSWER: Duration = Duration::from_millis(30);

/// What to do now.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Next {
    /// Draw a picture.
    Draw,
    /// Send a request alone.
    Probe,
    /// Wait for this long, unless something happens.
    Wait(Duration),
    /// Wait until something happens.
    Rest,
}

/// A line that was silent and is no more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Return {
    /// How long the line was silent.
    pub(super) silence: Duration,
    /// Number of pictures that would have been shown meanwhile.
    pub(super) skipped: u128,
}

/// Decides when pictures are drawn and sent.
#[derive(Debug)]
pub(super) struct Pacer {
    /// Shortest time between two pictures of a running run.
    interval: Duration,
    /// Whether the picture on the screen is old, and if so, from when on a new one may be drawn.
    dirty: Option<Duration>,
    /// Whether the user waits for a picture, and if so, from when on it may be drawn.
    urgent: Option<Duration>,
    last: Option<Duration>,
    sending: bool,
    /// First and last change of size not yet drawn.
    resized: Option<(Duration, Duration)>,
    /// Last change of size.
    size_since: Option<Duration>,
    /// How long a size has to last before it is drawn.
    settle: Duration,
    line: Line,
    budget: Budget,
}

impl Pacer {
    /// A pacer for at most `rate` pictures and, if there is a cap, `bytes` per second.
    pub(super) fn new(rate: u32, bytes: Option<u64>) -> Pacer {
        Pacer {
            interval: Duration::from_secs(1) / rate,
            dirty: None,
            urgent: None,
            last: None,
            sending: false,
            resized: None,
            size_since: None,
            settle: SETTLE,
            line: Line::new(),
            budget: Budget::new(bytes),
        }
    }

    fn interval(&self) -> Duration {
        self.interval.max(self.line.interval())
    }

    /// Notes that something changed: it will be shown in its turn.
    pub(super) fn changed(&mut self, now: Duration) {
        let turn = self.last.map_or(now, |last| last + self.interval()).max(now);
        self.dirty = Some(self.dirty.map_or(turn, |due| due.min(turn)));
    }

    /// Notes that something changed that the user waits for.
    pub(super) fn urgent(&mut self, now: Duration) {
        self.changed(now);
        self.urgent = Some(self.urgent.map_or(now, |due| due.min(now)));
    }

    /// Notes that a key was pressed; `asked` if the simulation has been told, and what it makes of it will come soon.
    pub(super) fn pressed(&mut self, now: Duration, asked: bool) {
        self.line.pressed(now);
        self.urgent(if asked { now + ANSWER } else { now });
    }

    /// Notes that the size changed.
    pub(super) fn resized(&mut self, now: Duration) {
        let first = self.resized.map_or(now, |(first, _)| first);
        self.resized = Some((first, now));
        let drag = self.size_since.is_some_and(|since| now < since + DRAG);
        self.settle = if drag { SETTLE_DRAG } else { SETTLE };
        self.size_since = Some(now);
    }

    /// Notes that a picture has been drawn.
    pub(super) fn drawn(&mut self, now: Duration) {
        (self.dirty, self.urgent, self.resized, self.last) = (None, None, None, Some(now));
    }

    /// Notes that a picture of `bytes` goes out; whether a request should follow it.
    pub(super) fn sending(&mut self, now: Duration, bytes: usize) -> bool {
        self.sending = true;
        self.budget.spend(bytes, now);
        self.line.sending(now, bytes)
    }

    /// Notes that a request goes out alone.
    pub(super) fn probing(&mut self, now: Duration) {
        self.sending = true;
        self.line.probing(now);
    }

    /// Notes that a request has gone out, and was taken by the system.
    pub(super) fn asked(&mut self, now: Duration) {
        self.line.probing(now);
    }

    /// Notes that the system has taken what was sent last.
    pub(super) fn sent(&mut self) {
        self.sending = false;
    }

    /// Notes that the terminal has answered a request; the return of the line, if it was silent.
    pub(super) fn replied(&mut self, now: Duration) -> Option<Return> {
        let silence = self.line.replied(now)?;
        let waited = self.dirty.map_or(Duration::ZERO, |due| now.saturating_sub(due));
        Some(Return { silence, skipped: waited.as_nanos() / self.interval().as_nanos().max(1) })
    }

    /// Lets go of the requests under way: another program has read the terminal.
    pub(super) fn forget_requests(&mut self) {
        self.line.forget();
    }

    /// How long answers under way are worth waiting for; `None`: there are none.
    pub(super) fn answers_within(&self) -> Option<Duration> {
        self.line.answers_within()
    }

    pub(super) fn next(&mut self, now: Duration) -> Next {
        self.line.tick(now);
        let settled = self.resized.map(|(first, last)| (last + self.settle).min(first + UNSETTLED));
        // Between two sizes of a drag a picture of the run would be of no more use than one of a size.
        let calm = self.size_since.map_or(Duration::ZERO, |since| since + self.settle);
        let changed = self.dirty.map(|due| due.max(calm));
        let Some(due) = settled.or(self.urgent).or(changed).filter(|_| !self.sending) else { return Next::Rest };
        let urgent = settled.or(self.urgent).is_some();
        if !urgent && self.line.wants_probe(now) {
            return Next::Probe;
        }
        if !self.line.has_room(urgent) {
            return self.line.gives_up_at().map_or(Next::Rest, |at| Next::Wait(at.saturating_sub(now)));
        }
        match due.max(self.budget.allows_from(urgent)).saturating_sub(now) {
            Duration::ZERO => Next::Draw,
            wait => Next::Wait(wait),
        }
    }
}

#[cfg(test)]
mod tests;
