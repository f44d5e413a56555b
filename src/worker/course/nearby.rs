//! Keyframes near the frame shown: kept on the way, or while nothing else is to do.

use super::{CLOSE, Course, RECENT, scout::Scout};

impl Course {
    /// Keeps what comes shortly before the frame that the run is on its way to: the next step back is quick then.
    pub(super) fn keep_on_the_way(&mut self) {
        let frame = self.frame();
        let Some((target, meter)) = &mut self.toward else { return };
        if !self.whole || frame >= *target || frame + RECENT < *target {
            return;
        }
        let mut since = *meter;
        let work = since.read(&self.simulation);
        if work > CLOSE {
            *meter = since;
            self.keyframes.insert(&self.simulation, (self.changed, &self.acting), work);
        }
    }

    /// Sees to it, with nothing else to do, that the last frames before the one shown are a short way off, for about
    /// `work`; whether there is more to do. `clock` tells the time, s.
    pub(in crate::worker) fn scout(&mut self, work: u64, clock: impl Fn() -> f64) -> bool {
        let shown = self.frame();
        let Some(scout) = self.scout.as_mut().filter(|scout| scout.shown == shown) else {
            self.scout = self.send_scout(shown);
            return self.scout.is_some();
        };
        if !scout.goes_home(work, clock) {
            return true;
        }
        self.scouted = Some(shown);
        if let Some((run, told, work)) = self.scout.take().and_then(|scout| scout.found()) {
            self.keyframes.insert(&run, (told.0, &told.1), work);
        }
        false
    }

    fn send_scout(&self, shown: u64) -> Option<Box<Scout>> {
        let kept = self.keyframes.lacking_before(shown).filter(|_| self.scouted != Some(shown))?;
        let target = shown - RECENT;
        let change = self.changes.get(kept.changes).map_or(u64::MAX, |change| change.frame);
        (change > target).then(|| Box::new(Scout::toward(target, shown, kept)))
    }
}
