//! Keyframes where one goes back and forth: put there on the way, or while nothing else is to do.

use super::{CLOSE, Course, RECENT, scout::Scout};
use crate::scene::Method;

impl Course {
    /// Keeps what comes shortly before the frame that the run is on its way to: the next step back is quick then.
    pub(super) fn keep_on_the_way(&mut self) {
        let (frame, acts) = (self.frame(), self.is_acted_on());
        let Some((target, meter)) = &mut self.toward else { return };
        if !self.whole || frame >= *target || frame + RECENT < *target {
            return;
        }
        let mut since = *meter;
        let work = since.read(&self.simulation);
        if work > CLOSE {
            *meter = since;
            self.keyframes.insert(&self.simulation, (self.changed, acts), work);
        }
    }

    /// Whether impulses of the frame before have acted over the one that is shown.
    pub(super) fn is_acted_on(&self) -> bool {
        !self.acting.over(&self.simulation).is_empty()
    }

    /// With nothing else to do: sees to it that the last frames before the one shown are a short way off, for about
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
        if let Some((run, changes, work)) = self.scout.take().and_then(|scout| scout.found()) {
            // what acts over that frame is not known
            let acts = run.settings().method == Method::Paper;
            self.keyframes.insert(&run, (changes, acts), work);
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
