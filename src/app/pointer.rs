//! What the mouse does: a click selects, a drag pans, the wheel zooms at the pointer, and the timeline goes to a time.

use ratatui::layout::Position;

use super::{
    input::Effect,
    keys::{Code, Key},
    mouse::{Gesture, Held, Mouse, Pointer},
    state::{Open, State},
    view_settings,
};
use crate::view::{self, Aim, Screen, Target};

impl State {
    /// Turns the mouse on or off.
    pub(super) fn toggle_mouse(&mut self) {
        self.pointer = Pointer { on: !self.pointer.on, held: None };
        self.say(if self.pointer.on {
            "Mouse on: click selects, drag pans, wheel zooms, the timeline goes to a time. Text: mostly with Shift."
        } else {
            "Mouse off: the terminal selects text again."
        });
    }

    /// Obeys the mouse; `show` lends the screen as it stands.
    pub(super) fn mouse(&mut self, mouse: Mouse, look: impl Fn(&State, &mut dyn FnMut(&Screen))) -> Effect {
        if !self.pointer.on {
            return Effect::Nothing; // a report that was under way when it was turned off
        }
        if !matches!(self.open, Open::Nothing) {
            return self.mouse_over_list(mouse);
        }
        match mouse.gesture {
            Gesture::Press => self.press(mouse.at(), look),
            Gesture::Drag => self.drag(mouse.at(), look),
            Gesture::Release => self.release(mouse.at(), look),
            Gesture::WheelUp => self.wheel(view_settings::ZOOM, mouse.at(), look),
            Gesture::WheelDown => self.wheel(1.0 / view_settings::ZOOM, mouse.at(), look),
        }
    }

    /// Obeys the mouse over a list or the help: the wheel does what the arrows do.
    fn mouse_over_list(&mut self, mouse: Mouse) -> Effect {
        self.pointer.held = None;
        match (mouse.gesture, &self.open) {
            (_, Open::Prompt(_)) => Effect::Nothing,
            (Gesture::WheelUp, _) => self.key(Key::plain(Code::Up)),
            (Gesture::WheelDown, _) => self.key(Key::plain(Code::Down)),
            _ => Effect::Nothing,
        }
    }

    fn press(&mut self, at: Position, look: impl Fn(&State, &mut dyn FnMut(&Screen))) -> Effect {
        let (mut aim, mut time, area) = (None, None, self.area);
        look(self, &mut |screen| (aim, time) = (Aim::at(screen, area, at), view::time_at(screen, area, at)));
        self.pointer.held = aim.map(|aim| Held::View { aim, last: at, moved: false });
        let Some(time) = time else { return Effect::Nothing };
        self.pointer.held = Some(Held::Timeline { column: at.x });
        (self.answer, self.news) = (None, None);
        self.goto(time);
        Effect::DrawNow
    }

    fn drag(&mut self, at: Position, look: impl Fn(&State, &mut dyn FnMut(&Screen))) -> Effect {
        match self.pointer.held {
            Some(Held::View { aim, last, .. }) if at != last => {
                self.let_go();
                let cells = |from: u16, to: u16| f64::from(to) - f64::from(from);
                self.view_settings.pan -= aim.shift(cells(last.x, at.x), cells(last.y, at.y));
                self.pointer.held = Some(Held::View { aim, last: at, moved: true });
                Effect::Draw
            }
            Some(Held::Timeline { column }) if at.x != column => {
                let (mut time, area) = (None, self.area);
                let row = Position::new(at.x, view::timeline_row(&self.view_settings, area).unwrap_or(at.y));
                look(self, &mut |screen| time = view::time_at(screen, area, row));
                self.pointer.held = Some(Held::Timeline { column: at.x });
                let Some(time) = time else { return Effect::Nothing };
                self.goto(time);
                Effect::Draw
            }
            _ => Effect::Nothing,
        }
    }

    fn release(&mut self, at: Position, look: impl Fn(&State, &mut dyn FnMut(&Screen))) -> Effect {
        let Some(Held::View { aim, moved: false, last }) = self.pointer.held.take() else { return Effect::Nothing };
        if last != at {
            return Effect::Nothing;
        }
        let mut target = None;
        look(self, &mut |screen| target = aim.nearest(screen, at));
        (self.answer, self.news) = (None, None);
        match target {
            None => self.say("This scene has no spheres."),
            Some(Target::Sphere(index)) => self.take(index),
            Some(Target::Contact(index)) => {
                let contact = self.report.snapshot.contacts[index];
                self.take(contact.a);
                self.view_settings.card = Some(self.card_of(index));
            }
        }
        Effect::DrawNow
    }

    /// Selects a sphere. A view that follows goes on with the new one.
    fn take(&mut self, index: usize) {
        self.view_settings.selected = Some(index);
        let name = self.report.snapshot.stage.names.get(index).and_then(Option::as_deref);
        let name = name.map_or(String::new(), |name| format!(" ({name})"));
        self.say(format!("Sphere {index}{name} is selected."));
    }

    fn wheel(&mut self, factor: f64, at: Position, look: impl Fn(&State, &mut dyn FnMut(&Screen))) -> Effect {
        let (mut aim, area, before) = (None, self.area, self.view_settings.zoom);
        look(self, &mut |screen| aim = Aim::at(screen, area, at));
        let Some(aim) = aim else { return Effect::Nothing };
        (self.answer, self.news) = (None, None);
        let end = if factor > 1.0 { "This is the closest view." } else { "This is the widest view." };
        self.zoom(factor, end);
        if !self.view_settings.follow {
            // What was under the pointer stays there.
            self.view_settings.pan += aim.offset(at) * (1.0 - before / self.view_settings.zoom);
        }
        Effect::DrawNow
    }
}
