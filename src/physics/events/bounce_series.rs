//! Series of bounces in closed form: infinitely many in finite time, or as many as are faster than what rests.
//!
//! A sphere that has just left a face, pressed with g_n, after an approach at u, is back after T e, then after T e² more
//! and so on, T = 2u/g_n. Each impact multiplies the speed along the face by `tangential` = τ, each flight adds a t to it,
//! a the acceleration along the face. So right after impact k it is p_k = τ (p_{k−1} + a T eᵏ), and the way along the
//! face is the sum of p_{k−1} T eᵏ + ½ a (T eᵏ)². All sums are geometric.

use glam::DVec3;

/// Bounces still to come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bounces {
    /// Restitution, 0 < e < 1.
    pub(super) e: f64,
    /// Share τ of the tangential velocity that an impact leaves, 0 ≤ τ ≤ 1.
    pub(super) tangential: f64,
    /// Approach speed u of the impact that has just been, m/s.
    pub(super) speed: f64,
    /// Acceleration g_n towards the face, m/s².
    pub(super) press: f64,
    /// Tangential velocity now, right after an impact, m/s.
    pub(super) slip: DVec3,
    /// Acceleration along the face, m/s².
    pub(super) pull: DVec3,
}

/// Where a series of bounces ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ending {
    /// How long the series lasts, s.
    pub(super) after: f64,
    /// The way along the face, m.
    pub(super) way: DVec3,
    /// Tangential velocity at the end, m/s.
    pub(super) slip: DVec3,
    /// Share that is left at the end of a tangential velocity added now.
    pub(super) keeps: f64,
}

/// A series between two bounces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Moment {
    /// Speed at which the sphere left the face last, m/s.
    pub(super) speed: f64,
    /// Tangential velocity, m/s.
    pub(super) slip: DVec3,
    /// Share that is left of a tangential velocity added at the beginning.
    pub(super) keeps: f64,
    /// The way along the face since the beginning, m.
    pub(super) way: DVec3,
}

/// What m impacts multiply by: eᵐ, τᵐ and Σ τ^{m−1−i} eⁱ over i < m.
#[derive(Debug, Clone, Copy)]
struct ImpactFactors {
    e: f64,
    tangential: f64,
    sum: f64,
}

impl ImpactFactors {
    const NONE: ImpactFactors = ImpactFactors { e: 1.0, tangential: 1.0, sum: 0.0 };

    fn then(self, more: ImpactFactors) -> ImpactFactors {
        ImpactFactors {
            e: self.e * more.e,
            tangential: self.tangential * more.tangential,
            sum: self.sum * more.tangential + self.e * more.sum,
        }
    }
}

impl Bounces {
    /// The end of the series at the first approach of at most `bound` < 1 times the last one; 0: never.
    pub(super) fn ending(&self, bound: f64) -> Ending {
        let Bounces { e, tangential, speed, slip, pull, .. } = *self;
        let (time, before_last) = (self.time(), self.above(bound));
        let power = (before_last.e * e).min(bound);
        let after = 2.0 * speed * e * (1.0 - power) / (self.press * (1.0 - e));
        if bound <= 0.0 {
            let keeps = before_last.tangential;
            return Ending { after, way: self.whole_way(), slip: (slip + pull * after) * keeps, keeps };
        }
        let carried = slip * before_last.tangential + pull * (time * tangential * e * before_last.sum);
        let arrival = carried + pull * (time * power);
        let later = Bounces { slip: arrival * tangential, speed: speed * power, ..*self };
        Ending { after, way: self.whole_way() - later.whole_way(), slip: arrival, keeps: before_last.tangential }
    }

    /// Where the series is `elapsed` ≥ 0 (s) after it began, if it is not over by then.
    pub(super) fn at(&self, elapsed: f64) -> Moment {
        let Bounces { e, tangential, speed, slip, pull, .. } = *self;
        // m flights last T e (1 − eᵐ)/(1 − e)
        let whole = self.time() * e / (1.0 - e);
        let done = self.above((1.0 - elapsed / whole).clamp(f64::MIN_POSITIVE, 1.0));
        let flying = elapsed - whole * (1.0 - done.e);
        let left = slip * done.tangential + pull * (self.time() * tangential * e * done.sum);
        let later = Bounces { slip: left, speed: speed * done.e, ..*self };
        let way = self.whole_way() - later.whole_way() + (left + pull * (0.5 * flying)) * flying;
        Moment { speed: speed * e * done.e, slip: left + pull * flying, keeps: done.tangential, way }
    }

    /// How much of `pull` (dimensionless) moves the sphere on over the whole of an endless series.
    pub(super) fn share_of_pull(&self) -> f64 {
        let Bounces { e, tangential, .. } = *self;
        (1.0 - e) * (1.0 + tangential * e) / ((1.0 + e) * (1.0 - tangential * e))
    }

    /// The way along the face of all bounces, however slow, m.
    fn whole_way(&self) -> DVec3 {
        let Bounces { e, tangential, slip, pull, .. } = *self;
        let after = self.time() * e / (1.0 - e);
        slip * (self.time() * e / (1.0 - tangential * e)) + pull * (0.5 * after * after * self.share_of_pull())
    }

    /// Duration T of a flight without loss, 2u/g_n, s.
    fn time(&self) -> f64 {
        2.0 * self.speed / self.press
    }

    /// The factors of as many impacts as leave more than `bound` < 1 of the speed.
    fn above(&self, bound: f64) -> ImpactFactors {
        if bound <= 0.0 {
            return ImpactFactors { e: 0.0, tangential: f64::from(u8::from(self.tangential == 1.0)), sum: 0.0 };
        }
        // 1, 2, 4 … impacts: as many as leave more than the bound, at most 53 + 11 of them
        let mut doubled = vec![ImpactFactors { e: self.e, tangential: self.tangential, sum: 1.0 }];
        while let Some(&last) = doubled.last().filter(|last| last.e * last.e > bound) {
            doubled.push(last.then(last));
        }
        let more = |sofar: ImpactFactors, &more: &ImpactFactors| {
            let both = sofar.then(more);
            if both.e > bound { both } else { sofar }
        };
        doubled.iter().rev().fold(ImpactFactors::NONE, more)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How a series ends, counted bounce by bounce in order.
    fn counted(bounces: &Bounces, bound: f64) -> Ending {
        let Bounces { e, tangential, mut slip, pull, .. } = *bounces;
        let time = bounces.time();
        let (mut power, mut after, mut way, mut keeps) = (1.0, 0.0, DVec3::ZERO, 1.0);
        loop {
            power *= e;
            let t = time * power;
            after += t;
            way += slip * t + pull * (0.5 * t * t);
            slip += pull * t;
            // 0.999 of the least number rounds to itself: what is this slow adds nothing any more
            let endless = bound == 0.0 && power < 1e-30;
            if endless && tangential < 1.0 {
                // what has not been rubbed away by then is so by the rest of infinitely many
                (slip, keeps) = (DVec3::ZERO, 0.0);
            }
            if power <= bound || endless {
                return Ending { after, way, slip, keeps };
            }
            slip *= tangential;
            keeps *= tangential;
        }
    }

    #[test]
    fn a_moment_of_a_series_is_the_one_that_counting_finds() {
        for (e, tangential) in [0.1, 0.5, 0.9].into_iter().flat_map(|e| [0.0, 0.3, 0.99].map(|t| (e, t))) {
            let (slip, pull) = (DVec3::X, DVec3::new(-0.5, 0.0, 2.0));
            let bounces = Bounces { e, tangential, speed: 3.0, press: 8.0, slip, pull };
            let (mut began, mut speed, mut now, mut keeps, mut so_far) = (0.0, 3.0 * e, slip, 1.0, DVec3::ZERO);
            for bounce in 0..30 {
                let flight = 2.0 * speed / 8.0;
                for part in [0.001, 0.3, 0.999] {
                    let found = bounces.at(began + part * flight);
                    let t = part * flight;
                    let way = so_far + (now + pull * (0.5 * t)) * t;
                    let expected = Moment { speed, slip: now + pull * t, keeps, way };
                    // the time within a flight that is short beside the series is a difference of times of a second
                    let rounding = 1e-15 / flight;
                    assert!(
                        (found.speed - speed).abs() <= 1e-13 * speed + rounding,
                        "{e} {bounce}: {found:?} {expected:?}"
                    );
                    assert!(
                        (found.slip - expected.slip).length() <= 1e-13 + rounding,
                        "{e} {bounce}: {found:?} {expected:?}"
                    );
                    assert!((found.way - expected.way).length() <= 1e-13, "{e} {bounce}: {found:?} {expected:?}");
                    assert!((found.keeps - keeps).abs() <= 1e-13 + rounding, "{e} {bounce}: {found:?} {expected:?}");
                }
                so_far += (now + pull * (0.5 * flight)) * flight;
                if flight < 1e-9 {
                    break;
                }
                began += flight;
                now = (now + pull * flight) * tangential;
                (speed, keeps) = (speed * e, keeps * tangential);
            }
        }
    }

    #[test]
    fn the_sums_are_those_that_counting_finds() {
        for (e, tangential) in
            [0.1, 0.5, 0.9, 0.999].into_iter().flat_map(|e| [0.0, 0.3, 0.5, e, 0.99, 1.0].map(|t| (e, t)))
        {
            for (slip, pull) in [(1.0, 0.0), (0.0, 1.0), (1.0, -3.0), (0.25, 2.0)] {
                let bounces = Bounces {
                    e,
                    tangential,
                    speed: 3.0,
                    press: 8.0,
                    slip: DVec3::X * slip,
                    pull: DVec3::new(pull, 0.0, pull),
                };
                // none that a power of e meets but for rounding: there either neighbour is right
                for bound in [0.0, 0.999_999, 0.55, 0.26, 0.12, 1e-3, 2e-12] {
                    let (found, expected) = (bounces.ending(bound), counted(&bounces, bound));
                    // Counting rounds each of ln(bound) / ln(e) steps, down to the least number where nothing else ends it.
                    let steps = (bound.max(1e-20).ln() / e.ln()).abs() + 1.0;
                    let rounding = 16.0 * steps * f64::EPSILON;
                    let size = (0.75 / (1.0 - e)) * (slip.abs() + 2.0 * pull.abs() * 0.75 / (1.0 - e));
                    assert!((found.after - expected.after).abs() <= rounding * expected.after, "{bounces:?} {bound}");
                    assert!(
                        (found.way - expected.way).length() <= rounding * size,
                        "{bounces:?} {bound}: {found:?} {expected:?}"
                    );
                    assert!(
                        (found.slip - expected.slip).length() <= rounding * size,
                        "{bounces:?} {bound}: {found:?} {expected:?}"
                    );
                    assert!(
                        (found.keeps - expected.keeps).abs() <= rounding,
                        "{bounces:?} {bound}: {found:?} {expected:?}"
                    );
                }
            }
        }
    }
}
