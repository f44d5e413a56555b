//! The loop: events in, pictures out.

use std::{
    io,
    os::fd::AsFd,
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
    input,
    outcome::{Error, Options, Outcome},
    pacer::{Next, Pacer},
    session::{Guard, Session},
    signals,
    writer::Writer,
};
use crate::{
    app::{App, Effect, Input, Key, Setup},
    frame::Encoder,
};

/// How a terminal is treated near by and across a network: pictures per second, and how long the rest of an escape
/// sequence may take.
const NEAR: (u32, Duration) = (30, Duration::from_millis(25));
const REMOTE: (u32, Duration) = (20, Duration::from_millis(100));

/// A long backlog of events is obeyed in turns of this length, with a picture after each where one is due.
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
    let (rate, escape_time) = if environment.remote() { REMOTE } else { NEAR };
    let setup = Setup {
        opened: options.opened,
        settings: options.settings,
        paused: options.paused,
        marker: environment.marker(options.marker),
        colors: environment.colors(options.color),
    };
    let (sender, events) = mpsc::channel();
    let post = Post(sender);
    let news = post.clone();
    let mut app = App::new(setup, Arc::new(move || news.send(Event::News)))?;
    options.message.into_iter().for_each(|message| app.say(message));
    let guard = Session::start(io::stdout().as_fd(), post.clone())?;
    signals::start(Arc::clone(guard.session()), post.clone())?;
    let writer = Writer::start(Arc::clone(guard.session()), post.clone())?;
    let (entrance, backlog) = backlog(post);
    input::start(escape_time, entrance)?;
    let pacer = Pacer::new(rate);
    let (encoder, clock) = (Encoder::new(), Instant::now());
    Driver { app, environment, guard, events, backlog, writer, pacer, encoder, clock }.run()
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
}

/// Whether, and how, the loop ends.
type Step = Result<Option<Outcome>, Error>;

impl Driver {
    fn run(mut self) -> Result<Outcome, Error> {
        self.pacer.urgent(Duration::ZERO);
        loop {
            let event = match self.pacer.next(self.clock.elapsed()) {
                Next::Draw => {
                    self.draw();
                    continue;
                }
                Next::Rest => self.events.recv().ok(),
                Next::Wait(time) => match self.events.recv_timeout(time) {
                    Err(RecvTimeoutError::Timeout) => continue,
                    event => event.ok(),
                },
            };
            // Everything that has arrived counts before the next picture, unless it takes long.
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
        if self.backlog.interrupted()
            && let Some(outcome) = self.handle(Input::Key(Key::ctrl('c')))?
        {
            return Ok(Some(outcome));
        }
        match event {
            Event::Typed(input) => {
                let step = self.handle(input);
                let left_out = self.backlog.obeyed();
                if left_out > 0 {
                    self.app.say(format!("{left_out} keys came faster than they could be obeyed, and were left out."));
                }
                return step;
            }
            Event::News => return self.handle(Input::News),
            Event::Interrupted => {}
            Event::Sent => self.pacer.sent(),
            Event::Resized => self.pacer.resized(self.clock.elapsed()),
            Event::Suspend => self.suspend()?,
            Event::Continued => {
                // While we were stopped, any program may have changed the terminal.
                if self.guard.session().take().is_err() {
                    return Ok(Some(Outcome::Signal(SIGHUP)));
                }
                self.repaint();
            }
            Event::End(signal) => return Ok(Some(Outcome::Signal(signal))),
            Event::Gone => return Ok(Some(Outcome::Signal(SIGHUP))),
            Event::Panicked(said) => return Err(Error::Panic(said.lines().collect::<Vec<_>>().join(" "))),
        }
        Ok(None)
    }

    fn handle(&mut self, input: Input) -> Step {
        match self.app.handle(input) {
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
        if !signals::somebody_could_continue_us() {
            self.app.say("There is no shell that could continue carom, so it goes on.");
            self.repaint();
            return Ok(());
        }
        self.guard.session().give_back();
        // Continuing sends a signal of its own, which takes the terminal again.
        signals::stop().map_err(Error::Io)
    }

    fn repaint(&mut self) {
        self.encoder.forget();
        self.pacer.urgent(self.clock.elapsed());
    }

    fn draw(&mut self) {
        self.pacer.drawn(self.clock.elapsed());
        let takes = self.guard.session().takes();
        let (columns, rows) = self.environment.size(self.guard.session().size(io::stdout().as_fd()));
        let mut buffer = Buffer::empty(Rect::new(0, 0, columns.min(LARGEST.0), rows.min(LARGEST.1)));
        self.app.draw(&mut buffer);
        let picture = self.encoder.encode(&buffer, self.app.cursor());
        if !picture.is_empty() {
            self.pacer.sending();
            self.writer.send(picture, takes);
        }
    }
}
