//! The loop: events in, pictures out.

use std::{
    io::{self, Write},
    os::fd::AsFd,
    path::PathBuf,
    sync::{
        Arc,
        mpsc::{self, Receiver, RecvTimeoutError},
    },
    time::{Duration, Instant},
};

use ratatui::{buffer::Buffer, layout::Rect};
use rustix::termios::isatty;
use signal_hook::consts::SIGHUP;

use super::{
    backlog::{Backlog, backlog},
    detect::Environment,
    event::{Event, Post},
    input, mouse,
    outcome::{Error, Options, Outcome},
    pacer::{Next, Pacer, Return},
    questions::{Change, Questions},
    reply::{REQUEST, Reply},
    session::{Guard, Session},
    signals,
    writer::Writer,
};
use crate::{
    app::{App, Effect, Input, Setup},
    frame::Encoder,
};

/// Behind a program that answers for the terminal nothing tells how thin the line to it is: most pictures and bytes per
/// second there, as many as 256 kbit/s carry.
const MULTIPLEXED: (u32, u64) = (10, 32_000);

/// How long the rest of an escape sequence may take near by.
const NEAR: Duration = Duration::from_millis(25);
/// How long the rest of an escape sequence may take across a network.
const REMOTE: Duration = Duration::from_millis(100);

/// Longest wait at the end for answers that only our terminal's next reader would get, if it is no shell.
const LEAVE: Duration = Duration::from_millis(100);

/// Length of a turn in which a long backlog of events is obeyed, with a picture after each where one is due.
const TURN: Duration = Duration::from_millis(50);

/// Largest picture, columns and rows; beyond it no terminal is drawn, whatever it claims to be.
const LARGEST: (u16, u16) = (1000, 500);

/// Runs the application on the terminal of standard output until its user has had enough.
///
/// # Errors
/// If standard output is no terminal, the terminal fails, or the simulation does. The terminal is as before by then.
pub fn run(options: Options) -> Result<Outcome, Error> {
    if !isatty(io::stdout()) {
        return Err(Error::NoTerminal);
    }
    let environment = Environment::ours();
    let escape_time = if environment.remote() { REMOTE } else { NEAR };
    let (most, budget) =
        if environment.multiplexed() { (MULTIPLEXED.0, Some(MULTIPLEXED.1)) } else { (u32::MAX, None) };
    let pacer = Pacer::new(options.frame_rate.min(most), options.bandwidth.or(budget));
    let questions = Questions::open(&environment, options.marker, options.color);
    let setup = Setup {
        opened: options.opened,
        settings: options.settings,
        paused: options.paused,
        taken_apart: options.taken_apart,
        marker: environment.marker(options.marker),
        colors: environment.colors(options.color),
        inks: options.inks,
        keymap: options.keymap,
        recording: options.recording,
        folder: PathBuf::from("."),
    };
    let (sender, events) = mpsc::channel();
    let post = Post(sender);
    let news = post.clone();
    let mut app = App::new(setup, Arc::new(move || news.send(Event::News)))?;
    options.message.into_iter().for_each(|message| app.tell(message));
    let guard = Session::start(io::stdout().as_fd(), post.clone())?;
    signals::start(Arc::clone(guard.session()), post.clone())?;
    let writer = Writer::start(Arc::clone(guard.session()), post.clone())?;
    let (entrance, backlog) = backlog(post);
    input::start(escape_time, entrance)?;
    let (encoder, clock) = (Encoder::new(), Instant::now());
    let (mouse, unasked) = ((false, 0), questions.bytes());
    Driver { app, environment, guard, events, backlog, writer, pacer, encoder, clock, mouse, questions, unasked }.run()
}

/// The application and its terminal.
struct Driver {
    app: App,
    environment: Environment,
    guard: Guard,
    events: Receiver<Event>,
    backlog: Backlog,
    writer: Writer,
    pacer: Pacer,
    encoder: Encoder,
    clock: Instant,
    /// Whether the terminal reports the mouse since it was taken for that time.
    mouse: (bool, u64),
    questions: Questions,
    /// The questions in bytes, until they are sent.
    unasked: Vec<u8>,
}

/// Whether, and how, the loop ends.
type Step = Result<Option<Outcome>, Error>;

impl Driver {
    fn run(mut self) -> Result<Outcome, Error> {
        let outcome = self.until_the_end();
        let farewell = if outcome.is_ok() { self.app.finish() } else { None };
        match outcome {
            Ok(Outcome::Quit) => self.leave(!signals::a_shell_could_continue_us())?,
            Ok(Outcome::Signal(number)) if number != SIGHUP => self.leave(true)?,
            _ => {}
        }
        drop(self.guard);
        if let Some(said) = farewell {
            let _ = writeln!(io::stderr(), "carom: {said}"); // the terminal may be gone
        }
        outcome
    }

    fn until_the_end(&mut self) -> Result<Outcome, Error> {
        self.pacer.urgent(Duration::ZERO);
        loop {
            let event = match self.pacer.next(self.clock.elapsed()) {
                Next::Draw => {
                    self.draw();
                    continue;
                }
                Next::Probe => {
                    self.pacer.probing(self.clock.elapsed());
                    self.writer.send(REQUEST.to_vec(), self.guard.session().takes());
                    continue;
                }
                Next::Rest => self.events.recv().ok(),
                Next::Wait(time) => match self.events.recv_timeout(time) {
                    Err(RecvTimeoutError::Timeout) => continue,
                    event => event.ok(),
                },
            };
            // All that has arrived counts before the next picture, unless it takes long.
            let deadline = self.clock.elapsed() + TURN;
            let mut next = event;
            while let Some(event) = next {
                if let Some(outcome) = self.obey(event)? {
                    return Ok(outcome);
                }
                next = if self.clock.elapsed() < deadline { self.events.try_recv().ok() } else { None };
            }
        }
    }

    fn obey(&mut self, event: Event) -> Step {
        if self.backlog.interrupted() {
            return Ok(Some(Outcome::Quit)); // whatever is open: a Ctrl-C that only closes that has waited in vain
        }
        match event {
            Event::Typed(input) => {
                let left_out = self.backlog.obeyed(&input);
                let step = self.typed(input);
                if left_out > 0 {
                    self.app.tell(format!("{left_out} keys came faster than they could be obeyed, and were left out."));
                }
                return step;
            }
            Event::News => return self.handle(Input::News),
            Event::Replied => self.replied(),
            Event::Interrupted => {}
            Event::Sent => self.pacer.sent(),
            Event::Resized => self.pacer.resized(self.clock.elapsed()),
            Event::Suspend => self.suspend()?,
            Event::Continued => {
                // While we were stopped, any program may have changed the terminal.
                if self.guard.session().take().is_err() {
                    return Ok(Some(Outcome::Signal(SIGHUP)));
                }
                self.pacer.forget_requests();
                self.repaint();
            }
            Event::End(signal) => return Ok(Some(Outcome::Signal(signal))),
            Event::Gone => return Ok(Some(Outcome::Signal(SIGHUP))),
            Event::Panicked(said) => return Err(panicked(&said)),
        }
        Ok(None)
    }

    /// Obeys a key or a paste. Where the simulation has been told something, its answer is worth a moment.
    fn typed(&mut self, input: Input) -> Step {
        let effect = self.app.handle(input);
        if effect != Effect::DrawNow {
            return self.heed(effect);
        }
        self.pacer.pressed(self.clock.elapsed(), self.app.awaits_report());
        Ok(None)
    }

    fn handle(&mut self, input: Input) -> Step {
        let effect = self.app.handle(input);
        self.heed(effect)
    }

    fn replied(&mut self) {
        for (reply, at) in self.backlog.replies() {
            if let Some(change) = self.questions.hear(reply) {
                self.adapt(change);
            }
            if reply == Reply::Attributes
                && let Some(Return { silence, skipped }) = self.pacer.replied(at.duration_since(self.clock))
            {
                let seconds = silence.as_secs_f64();
                let pictures = if skipped == 1 { "frame was" } else { "frames were" };
                self.app.tell(format!("The line was silent for {seconds:.1} s; {skipped} {pictures} skipped."));
                self.pacer.urgent(self.clock.elapsed());
            }
        }
    }

    /// Adapts pictures to what the terminal can do, once it has said so.
    fn adapt(&mut self, change: Change) {
        match change {
            Change::Marker(marker) => self.app.adapt(|settings| settings.marker = marker),
            Change::Colors(colors) => self.app.adapt(|settings| settings.colors = colors),
            Change::Background(background) => self.app.adapt(|settings| settings.background = background),
            Change::Brackets(known) => return self.encoder.bracket(known),
        }
        self.pacer.changed(self.clock.elapsed());
    }

    /// Leaves the screen, and waits for answers under way: the next reader of the terminal would take them for keys. Only
    /// for a moment if that is no shell (`briefly`).
    ///
    /// # Errors
    /// If a thread panics meanwhile.
    fn leave(&mut self, briefly: bool) -> Result<(), Error> {
        // Until the terminal knows that it shall not, it reports the mouse; its answer tells when that is over.
        let farewell: &[u8] = if self.mouse.0 { REQUEST } else { b"" };
        let begin = self.clock.elapsed();
        if self.guard.session().leave_screen(farewell) && self.mouse.0 {
            self.pacer.asked(begin);
        }
        while let Some(patience) = self.pacer.answers_within() {
            let end = begin + if briefly { LEAVE } else { patience };
            match self.events.recv_timeout(end.saturating_sub(self.clock.elapsed())) {
                Ok(Event::Replied) => self.count_replies(),
                // After a suspension the loop goes on, and must have missed nothing.
                Ok(Event::Sent) => self.pacer.sent(),
                Ok(Event::Resized) => self.pacer.resized(self.clock.elapsed()),
                Ok(Event::News) => {
                    let _ = self.app.handle(Input::News);
                }
                Ok(Event::Typed(input)) => {
                    let _ = self.backlog.obeyed(&input);
                }
                Ok(Event::Interrupted | Event::Suspend | Event::Continued) => {}
                Ok(Event::Panicked(said)) => return Err(panicked(&said)),
                Ok(Event::Gone | Event::End(_)) | Err(_) => break,
            }
        }
        Ok(())
    }

    /// Takes note of replies of which nothing will be said.
    fn count_replies(&mut self) {
        for (_, at) in self.backlog.replies().into_iter().filter(|(reply, _)| *reply == Reply::Attributes) {
            let _ = self.pacer.replied(at.duration_since(self.clock));
        }
    }

    fn heed(&mut self, effect: Effect) -> Step {
        match effect {
            Effect::Nothing => {}
            Effect::Draw => self.pacer.changed(self.clock.elapsed()),
            Effect::DrawNow => self.pacer.urgent(self.clock.elapsed()),
            Effect::Repaint => self.repaint(),
            Effect::Suspend => self.suspend()?,
            Effect::Quit => return Ok(Some(Outcome::Quit)),
            Effect::Fail(said) => return Err(Error::Panic(said)),
        }
        Ok(None)
    }

    /// Gives the terminal to the shell and stops; says so instead if no shell could continue us.
    fn suspend(&mut self) -> Result<(), Error> {
        if !signals::a_shell_could_continue_us() {
            self.app.tell("There is no shell that could continue carom, so it goes on.");
            self.repaint();
            return Ok(());
        }
        self.leave(false)?;
        self.guard.session().give_back();
        // Continuing sends a signal of its own, which takes the terminal again.
        signals::stop().map_err(Error::Io)
    }

    fn repaint(&mut self) {
        self.encoder.forget();
        self.pacer.urgent(self.clock.elapsed());
    }

    /// What has the terminal report the mouse or not, as the application wants; it was taken `takes` times.
    fn mouse_mode(&mut self, takes: u64) -> &'static [u8] {
        let reports = self.mouse.0 && self.mouse.1 == takes; // giving the terminal back turned them off
        let wanted = self.app.wants_mouse();
        self.mouse = (wanted, takes);
        match (reports, wanted) {
            (false, true) => mouse::ON,
            (true, false) => mouse::OFF,
            _ => b"",
        }
    }

    fn draw(&mut self) {
        self.pacer.drawn(self.clock.elapsed());
        let takes = self.guard.session().takes();
        let (columns, rows) = self.environment.size(self.guard.session().size(io::stdout().as_fd()));
        let mut buffer = Buffer::empty(Rect::new(0, 0, columns.min(LARGEST.0), rows.min(LARGEST.1)));
        self.app.draw(&mut buffer);
        let picture = self.encoder.encode(&buffer, self.app.cursor());
        let picture = [&std::mem::take(&mut self.unasked), self.mouse_mode(takes), &picture].concat();
        if !picture.is_empty() {
            let now = self.clock.elapsed();
            let asks = self.pacer.sending(now, picture.len() + REQUEST.len());
            let bytes = if asks { [&picture, REQUEST].concat() } else { picture };
            self.writer.send(bytes, takes);
        }
    }
}

/// The text of a panic on one line.
fn panicked(said: &str) -> Error {
    Error::Panic(said.lines().collect::<Vec<_>>().join(" "))
}
