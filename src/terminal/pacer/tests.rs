//! The rhythm on terminals near and far, each of them a model with a clock of its own.

use std::collections::VecDeque;

use super::*;

const MS: Duration = Duration::from_millis(1);
const START: Duration = Duration::from_secs(7);

/// A line of so many bytes per second, and the terminal at its end.
struct Model {
    rate: u64,
    /// Time that it takes each way.
    delay: Duration,
    answers: bool,
    /// Time from which on the line carries nothing.
    free: Duration,
    /// When answers will arrive.
    replies: VecDeque<Duration>,
    /// When pictures are on the screen.
    shown: Vec<Duration>,
    /// Nothing is read between these moments.
    stalled: Option<(Duration, Duration)>,
}

impl Model {
    fn new(kilobits: u64, trip: u32) -> Model {
        Model {
            rate: kilobits * 1000 / 8,
            delay: trip * MS / 2,
            answers: true,
            free: Duration::ZERO,
            replies: VecDeque::new(),
            shown: Vec::new(),
            stalled: None,
        }
    }

    /// Takes bytes, and a request after them; when they are on the screen.
    fn take(&mut self, bytes: u64, now: Duration, request: bool) -> Duration {
        self.free = self.free.max(now) + Duration::from_nanos(bytes * 1_000_000_000 / self.rate);
        let mut seen = self.free + self.delay;
        if let Some((from, to)) = self.stalled
            && (from..to).contains(&seen)
        {
            seen = to;
        }
        if self.answers && request {
            self.replies.push_back(seen + self.delay);
        }
        seen
    }
}

/// A running run on a model, a picture being so many bytes.
struct Run {
    pacer: Pacer,
    model: Model,
    bytes: u64,
    now: Duration,
    returns: Vec<Return>,
}

impl Run {
    fn new(model: Model, bytes: u64) -> Run {
        let mut run = Run { pacer: Pacer::new(30, None), model, bytes, now: START, returns: Vec::new() };
        run.pacer.urgent(START);
        run
    }

    /// Draws if that is due; when the picture will be on the screen.
    fn draw(&mut self) -> Option<Duration> {
        match self.pacer.next(self.now) {
            Next::Draw => {}
            Next::Probe => {
                self.pacer.probing(self.now);
                self.pacer.sent();
                self.model.take(3, self.now, true);
                return None;
            }
            Next::Wait(_) | Next::Rest => return None,
        }
        self.pacer.drawn(self.now);
        // The first picture is a whole one.
        let bytes = if self.model.shown.is_empty() { 2 * self.bytes } else { self.bytes };
        let asks = self.pacer.sending(self.now, bytes as usize);
        self.pacer.sent();
        let seen = self.model.take(bytes, self.now, asks);
        self.model.shown.push(seen);
        Some(seen)
    }

    /// A millisecond passes; a picture that was drawn in it is on the screen then.
    fn step(&mut self, running: bool) -> Option<Duration> {
        self.now += MS;
        while self.model.replies.front().is_some_and(|at| *at <= self.now) {
            self.model.replies.pop_front();
            self.returns.extend(self.pacer.replied(self.now));
        }
        if running && self.now.as_millis().is_multiple_of(16) {
            self.pacer.changed(self.now);
        }
        self.draw()
    }

    fn go(&mut self, time: Duration) {
        let end = self.now + time;
        while self.now < end {
            self.step(true);
        }
    }

    /// Pictures per second over the next ten.
    fn rate(&mut self) -> usize {
        let before = self.model.shown.len();
        self.go(10_000 * MS);
        (self.model.shown.len() - before) / 10
    }

    /// The time from a key to its picture on the screen, both ways; the simulation answers after three milliseconds.
    fn press(&mut self) -> Duration {
        let pressed = self.now;
        self.go(self.model.delay);
        self.pacer.pressed(self.now, true);
        for _ in 0..3 {
            assert_eq!(self.step(true), None, "the simulation is awaited");
        }
        self.pacer.urgent(self.now);
        loop {
            if let Some(seen) = self.draw().or_else(|| self.step(true)) {
                return seen - pressed;
            }
        }
    }

    /// Median and the 19th of 20 latencies, the keys at all moments of the rhythm.
    fn latency(&mut self) -> (Duration, Duration) {
        let mut all: Vec<Duration> = (0..100)
            .map(|i| {
                self.go((700 + 37 * i % 501) * MS);
                self.press()
            })
            .collect();
        all.sort();
        (all[50], all[95])
    }
}

#[test]
fn a_paused_run_rests() {
    let mut pacer = Pacer::new(30, None);
    assert_eq!(pacer.next(START), Next::Rest);
    pacer.urgent(START);
    assert_eq!(pacer.next(START), Next::Draw);
    pacer.drawn(START);
    assert_eq!(pacer.next(START + 1000 * MS), Next::Rest);
}

#[test]
fn news_waits_for_its_turn_and_keys_do_not() {
    let mut pacer = Pacer::new(20, None);
    pacer.drawn(START);
    pacer.changed(START + 10 * MS);
    pacer.changed(START + 30 * MS);
    assert_eq!(pacer.next(START + 30 * MS), Next::Wait(20 * MS));
    pacer.urgent(START + 31 * MS);
    assert_eq!(pacer.next(START + 31 * MS), Next::Draw);
}

#[test]
fn a_key_waits_a_moment_for_the_simulation() {
    let mut pacer = Pacer::new(20, None);
    pacer.drawn(START);
    pacer.pressed(START, true);
    assert_eq!(pacer.next(START), Next::Wait(ANSWER), "without it the picture would be of no use");
    pacer.urgent(START + 2 * MS);
    assert_eq!(pacer.next(START + 2 * MS), Next::Draw);
    pacer.drawn(START + 2 * MS);
    pacer.pressed(START + 3 * MS, false);
    assert_eq!(pacer.next(START + 3 * MS), Next::Draw, "the simulation has nothing to do with this one");
}

#[test]
fn nothing_is_drawn_while_the_system_has_not_taken_the_last_picture() {
    let mut pacer = Pacer::new(30, None);
    assert!(pacer.sending(START, 1000), "a request goes with it");
    pacer.urgent(START);
    assert_eq!(pacer.next(START + 1000 * MS), Next::Rest);
    pacer.sent();
    assert_eq!(pacer.next(START + 1000 * MS), Next::Draw);
}

#[test]
fn a_dragged_window_is_drawn_when_it_settles_or_now_and_then() {
    let mut pacer = Pacer::new(30, None);
    for ms in (0..=960).step_by(20) {
        pacer.resized(START + ms * MS);
        pacer.changed(START + ms * MS);
    }
    assert_eq!(pacer.next(START + 960 * MS), Next::Wait(40 * MS));
    pacer.resized(START + 980 * MS);
    assert_eq!(pacer.next(START + 980 * MS), Next::Wait(20 * MS));
    assert_eq!(pacer.next(START + 1000 * MS), Next::Draw);
    pacer.drawn(START + 1000 * MS);
    pacer.changed(START + 1001 * MS);
    assert_eq!(pacer.next(START + 1001 * MS), Next::Wait(99 * MS), "the hand may only pause");
    pacer.resized(START + 2000 * MS);
    assert_eq!(pacer.next(START + 2000 * MS), Next::Wait(30 * MS), "a size alone");
}

#[test]
fn forty_sizes_in_a_second_of_a_running_run_are_two_pictures() {
    let mut run = Run::new(Model::new(1_000_000, 1), 2000);
    run.go(2000 * MS);
    let before = run.model.shown.len();
    for _ in 0..40 {
        run.pacer.resized(run.now);
        run.go(25 * MS);
    }
    assert_eq!(run.model.shown.len() - before, 1, "while it is dragged");
    run.go(125 * MS);
    assert_eq!(run.model.shown.len() - before, 2, "and when it has settled");
}

#[test]
fn near_by_every_picture_is_shown_and_none_is_queued() {
    let mut run = Run::new(Model::new(1_000_000, 1), 2000);
    assert_eq!(run.rate(), 29, "a turn is 34 of these milliseconds");
    assert!(run.model.replies.len() <= 1);
}

#[test]
fn on_a_fast_and_long_line_the_window_makes_a_smooth_run() {
    let mut run = Run::new(Model::new(10_000, 100), 1900);
    run.go(2000 * MS);
    let rate = run.rate();
    assert!(rate >= 25, "{rate} pictures a second");
    let (median, late) = run.latency();
    assert!(median <= 115 * MS && late <= 120 * MS, "{median:?} {late:?}");
}

#[test]
fn on_a_thin_line_the_rate_is_dropped_and_not_the_answer() {
    for (kilobits, trip, bytes, most, latest, slowest) in
        [(256, 100, 1900, 250, 400, 5), (256, 100, 4200, 260, 400, 3), (64, 300, 1900, 900, 1200, 1)]
    {
        let mut run = Run::new(Model::new(kilobits, trip), bytes);
        run.go(2000 * MS);
        let rate = run.rate();
        assert!(rate >= slowest, "{kilobits} kbit/s: {rate} pictures a second");
        let (median, late) = run.latency();
        assert!(median <= most * MS && late <= latest * MS, "{kilobits} kbit/s: {median:?} {late:?}");
    }
}

#[test]
fn small_pictures_on_a_thin_line_do_not_make_room_for_large_ones() {
    let mut run = Run::new(Model::new(64, 300), 1900);
    run.go(3000 * MS);
    run.bytes = 60; // the help covers the scene
    run.go(5000 * MS);
    run.bytes = 1900;
    run.go(300 * MS);
    let queued = run.model.free.saturating_sub(run.now);
    assert!(queued <= 250 * MS, "{queued:?} of pictures are queued");
    let (median, late) = run.latency();
    assert!(median <= 900 * MS && late <= 1200 * MS, "{median:?} {late:?}");
}

#[test]
fn a_silent_line_gets_nothing_and_is_told_of_when_it_returns() {
    for (model, stale) in [(Model::new(1_000_000, 1), 1), (Model::new(256, 100), 1), (Model::new(10_000, 100), 3)] {
        let mut run = Run::new(model, 1900);
        run.go(5000 * MS);
        run.model.stalled = Some((run.now, run.now + 10_000 * MS));
        run.go(9990 * MS);
        let end = run.now + 10 * MS;
        let waiting = run.model.shown.iter().filter(|seen| **seen >= end).count();
        assert!(waiting <= stale, "{waiting} pictures are shown too late");
        run.go(1000 * MS);
        let [told] = run.returns[..] else { panic!("it is told once: {:?}", run.returns) };
        assert!((9_700..=10_200).contains(&told.silence.as_millis()), "{told:?}");
        assert!((280..=300).contains(&told.skipped), "{told:?}");
        run.go(2000 * MS);
        let before = run.model.shown.len();
        run.go(1000 * MS);
        assert!(run.model.shown.len() - before >= 5, "it goes on");
    }
}

#[test]
fn keys_on_a_silent_line_send_one_picture_and_no_more() {
    let mut run = Run::new(Model::new(10_000, 20), 1900);
    run.go(3000 * MS);
    run.model.stalled = Some((run.now, run.now + 9000 * MS));
    run.go(1000 * MS);
    let before = run.model.shown.len();
    for _ in 0..70 {
        run.pacer.pressed(run.now, false);
        run.go(100 * MS);
    }
    assert_eq!(run.model.shown.len() - before, 1);
}

#[test]
fn a_terminal_that_never_answers_gets_ten_pictures_a_second() {
    let mut model = Model::new(10_000, 1);
    model.answers = false;
    let mut run = Run::new(model, 1900);
    run.go(1400 * MS);
    assert_eq!(run.model.shown.len(), 1, "it may answer yet: 3800 bytes take half a second on a thin line");
    run.go(200 * MS);
    assert_eq!(run.rate(), 10);
    run.model.answers = true;
    run.go(LATER);
    assert!(run.rate() > 25, "it does after all");
}

/// Longer than a terminal's answers are waited for.
const LATER: Duration = Duration::from_secs(15);

#[test]
fn lost_answers_are_got_over_by_a_key() {
    let mut run = Run::new(Model::new(10_000, 20), 1900);
    run.go(3000 * MS);
    run.model.replies.clear();
    run.go(LATER);
    let before = run.model.shown.len();
    run.pacer.pressed(run.now, false);
    run.go(3000 * MS);
    assert!(run.model.shown.len() - before > 30, "it goes on");
    // A terminal that has ceased to answer is found out.
    run.model.answers = false;
    for _ in 0..4 {
        run.go(LATER);
        run.pacer.pressed(run.now, false);
    }
    assert_eq!(run.rate(), 10);
}

#[test]
fn answers_that_nobody_asked_for_change_nothing() {
    let mut run = Run::new(Model::new(256, 100), 1900);
    run.go(3000 * MS);
    run.model.replies.clear();
    run.pacer.forget_requests();
    assert_eq!(run.pacer.replied(run.now), None);
    assert_eq!(run.pacer.answers_within(), None);
    assert!(run.rate() < 10, "as before");
}
