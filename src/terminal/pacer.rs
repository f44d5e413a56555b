//! When the next picture is drawn: only if something changed, only if the last one has been sent, and not too often.
//! Moments are given as times since any fixed start.

use std::time::Duration;

/// A window that is being dragged settles for this long before it is drawn again.
const SETTLE: Duration = Duration::from_millis(30);

/// A window that never settles is drawn this often.
const UNSETTLED: Duration = Duration::from_millis(250);

/// What to do now.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Next {
    /// Draw.
    Draw,
    /// Nothing until then, unless something happens.
    Wait(Duration),
    /// Nothing until something happens.
    Rest,
}

/// Keeps the rhythm.
#[derive(Debug)]
pub(super) struct Pacer {
    /// Shortest time between two pictures of a running run.
    interval: Duration,
    /// Whether the picture on the screen is old, and if so, from when on a new one may be drawn.
    dirty: Option<Duration>,
    last: Option<Duration>,
    sending: bool,
    /// First and last change of size not yet drawn.
    resized: Option<(Duration, Duration)>,
}

impl Pacer {
    /// At most `rate` pictures per second.
    pub(super) fn new(rate: u32) -> Pacer {
        Pacer { interval: Duration::from_secs(1) / rate, dirty: None, last: None, sending: false, resized: None }
    }

    /// Something changed; it will be shown in its turn.
    pub(super) fn changed(&mut self, now: Duration) {
        let turn = self.last.map_or(now, |last| last + self.interval);
        self.dirty = Some(self.dirty.map_or(turn, |due| due.min(turn)));
    }

    /// Something changed that the user waits for.
    pub(super) fn urgent(&mut self, now: Duration) {
        self.dirty = Some(now);
    }

    /// The size changed.
    pub(super) fn resized(&mut self, now: Duration) {
        let first = self.resized.map_or(now, |(first, _)| first);
        self.resized = Some((first, now));
    }

    /// A picture goes to the terminal.
    pub(super) fn drawn(&mut self, now: Duration) {
        (self.dirty, self.resized, self.last) = (None, None, Some(now));
    }

    /// A picture is on its way.
    pub(super) fn sending(&mut self) {
        self.sending = true;
    }

    /// The terminal has taken the last picture.
    pub(super) fn sent(&mut self) {
        self.sending = false;
    }

    pub(super) fn next(&self, now: Duration) -> Next {
        let settled = self.resized.map(|(first, last)| (last + SETTLE).min(first + UNSETTLED));
        let Some(due) = settled.or(self.dirty).filter(|_| !self.sending) else { return Next::Rest };
        match due.saturating_sub(now) {
            Duration::ZERO => Next::Draw,
            wait => Next::Wait(wait),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: Duration = Duration::from_millis(1);
    const START: Duration = Duration::from_secs(7);

    #[test]
    fn a_paused_run_rests() {
        let mut pacer = Pacer::new(30);
        assert_eq!(pacer.next(START), Next::Rest);
        pacer.urgent(START);
        assert_eq!(pacer.next(START), Next::Draw);
        pacer.drawn(START);
        assert_eq!(pacer.next(START + 1000 * MS), Next::Rest);
    }

    #[test]
    fn news_waits_for_its_turn_and_keys_do_not() {
        let mut pacer = Pacer::new(20);
        pacer.drawn(START);
        pacer.changed(START + 10 * MS);
        pacer.changed(START + 30 * MS);
        assert_eq!(pacer.next(START + 30 * MS), Next::Wait(20 * MS));
        pacer.urgent(START + 31 * MS);
        assert_eq!(pacer.next(START + 31 * MS), Next::Draw);
    }

    #[test]
    fn nothing_is_drawn_while_the_terminal_has_not_taken_the_last_picture() {
        let mut pacer = Pacer::new(30);
        pacer.sending();
        pacer.urgent(START);
        assert_eq!(pacer.next(START + 1000 * MS), Next::Rest);
        pacer.sent();
        assert_eq!(pacer.next(START + 1000 * MS), Next::Draw);
    }

    #[test]
    fn a_dragged_window_is_drawn_when_it_settles_or_four_times_a_second() {
        let mut pacer = Pacer::new(30);
        for ms in (0..=200).step_by(20) {
            pacer.resized(START + ms * MS);
            pacer.urgent(START + ms * MS);
        }
        assert_eq!(pacer.next(START + 200 * MS), Next::Wait(30 * MS));
        for ms in (220..=240).step_by(20) {
            pacer.resized(START + ms * MS);
        }
        assert_eq!(pacer.next(START + 240 * MS), Next::Wait(10 * MS));
        assert_eq!(pacer.next(START + 250 * MS), Next::Draw);
    }
}
