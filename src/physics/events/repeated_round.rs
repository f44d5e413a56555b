//! A round of impacts that comes again and again at one place: many rounds at once.
//!
//! While nothing moves, an impact maps the velocities of its bodies linearly, and so does a round of impacts; n rounds are
//! the n-th power of that map, found by squaring. So a chain of a billion impacts (a light ball between a heavy one and a
//! wall: Galperin 2003) costs some thousand products, and a chain without end (inelastic collapse: McNamara, Young 1992)
//! is followed to where nothing approaches by more than rounding. All is computed in numbers of 32 digits: a rounding
//! that each round repeats would grow with their number.
//!
//! Rounds are skipped only as long as no approach, and nothing else that touches, changes by more than a factor of two
//! from where the skip begins to its middle, its end, and the rounds that follow: in doubling steps, an approach that ends
//! is met at each halving of what is left, and never passed over.

use glam::DVec3;

use crate::double::Double;

/// Most doublings of a skip: 2⁶⁰ rounds are more than any chain can have that begins with numbers of 53 bits.
const MOST_DOUBLINGS: usize = 60;

/// Most skips in a row: each halves or doubles some approach, which rounding ends after fifty.
const MOST_SKIPS: usize = 400;

/// Rounds looked at beyond the end of each skip: a motion that comes back every few rounds shows there.
const ROUNDS_AFTER: usize = 3;

/// One impact of a round. Bodies are named by their places in the list of velocities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Strike {
    /// Direction in which the first body is pushed, about 1 long.
    pub(super) normal: DVec3,
    /// The first body, by its place.
    pub(super) a: usize,
    /// The other body, by its place; none: a wall.
    pub(super) b: Option<usize>,
    /// Inverse masses of both, 1/kg; 0: a wall.
    pub(super) inverse_masses: [f64; 2],
    /// Share of the approach speed with which the bodies part.
    pub(super) restitution: f64,
    /// Share of the tangential velocity that the impact leaves.
    pub(super) tangential: f64,
    /// Approach speed down to which it is an impact, m/s: beyond it, the contact rests.
    pub(super) slowest: f64,
    /// Approach speed up to which the contact does what it does, m/s.
    pub(super) fastest: f64,
    /// Whether it is no impact, but what touches beside the chain and stops a body that grazes it.
    pub(super) stops: bool,
}

/// A contact that touches without being struck: its bodies must not begin to approach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bystander {
    /// Unit normal, towards the first body.
    pub(super) normal: DVec3,
    /// The first body, by its place.
    pub(super) a: usize,
    /// The other body, by its place; none: a wall, or a sphere that no impact of the round strikes.
    pub(super) b: Option<usize>,
    /// Velocity of what is no body of the round, m/s.
    pub(super) velocity: DVec3,
    /// Whether the other body is a sphere.
    pub(super) is_pair: bool,
    /// Share of the speeds with which they may approach all the same: what stops them takes that little.
    pub(super) most: f64,
    /// Approach speed up to which they may approach all the same and are stopped, m/s: they rest on each other.
    pub(super) rests_up_to: f64,
}

impl Bystander {
    /// Whether the other body is a sphere that is none of the round's.
    pub(super) fn moves_alone(&self) -> bool {
        self.b.is_none() && self.is_pair
    }
}

/// A bystander that begins to approach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Met {
    /// The impact that comes next, by its place.
    pub(super) before: usize,
    /// The bystander, by its place.
    pub(super) bystander: usize,
    /// Approach speed, as a share of the speeds of both bodies.
    pub(super) share: f64,
    /// Approach speed, m/s.
    pub(super) approach_speed: f64,
}

/// What skipping rounds has come to.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Skipped {
    /// Number of rounds.
    pub(super) rounds: u64,
    /// Velocities after them, m/s, by place.
    pub(super) velocities: Vec<DVec3>,
    /// Sum of the approach speeds of each impact of the round, m/s.
    pub(super) approaches: Vec<f64>,
}

/// A round of impacts, one after the other, and what touches beside them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Round<'a> {
    pub(super) strikes: &'a [Strike],
    pub(super) bystanders: &'a [Bystander],
    /// Share of the speeds, those that the skip begins with, below which an approach is rounding.
    pub(super) rounding: f64,
}

/// Velocities (m/s), three numbers for each body, then the sum of the approach speeds (m/s) of each impact.
type Numbers = Vec<Double>;

/// A linear map of velocities: of each of their components, what it contributes to all numbers.
#[derive(Debug, Clone)]
struct Map {
    columns: Vec<Numbers>,
}

impl Strike {
    /// The unit normal to 32 digits: what is off in its length would be energy.
    fn direction(&self) -> [Double; 3] {
        let n = self.normal.to_array().map(Double::from);
        let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
        n.map(|component| component / length)
    }

    /// Does the impact; returns the approach speed, m/s.
    fn act(&self, n: &[Double; 3], v: &mut [Double]) -> Double {
        let relative = |k: usize| v[3 * self.a + k] - self.b.map_or(Double::ZERO, |b| v[3 * b + k]);
        let v_n = n[0] * relative(0) + n[1] * relative(1) + n[2] * relative(2);
        let change = -(Double::ONE + self.restitution.into()) * v_n;
        let [own, other] = self.inverse_masses.map(Double::from);
        for (k, &normal) in n.iter().enumerate() {
            let a = 3 * self.a + k;
            match self.b {
                Some(b) => {
                    v[a] = v[a] + normal * (change * own / (own + other));
                    v[3 * b + k] = v[3 * b + k] - normal * (change * other / (own + other));
                }
                None => {
                    let loses = Double::from(self.tangential) - Double::ONE;
                    v[a] = v[a] + normal * change + (v[a] - normal * v_n) * loses;
                }
            }
        }
        -v_n
    }
}

impl Map {
    /// The map of one round for so many bodies.
    fn of_round(walk: &Walk, bodies: usize) -> Map {
        let column = |j: usize| {
            let mut numbers = vec![Double::ZERO; 3 * bodies + walk.directions.len()];
            numbers[j] = Double::ONE;
            walk.act(&mut numbers);
            numbers
        };
        Map { columns: (0..3 * bodies).map(column).collect() }
    }

    /// The numbers that the map makes of these.
    fn apply(&self, numbers: &Numbers) -> Numbers {
        let width = self.columns.len();
        let mut result = vec![Double::ZERO; width];
        result.extend_from_slice(&numbers[width..]);
        for (column, &factor) in self.columns.iter().zip(numbers) {
            result.iter_mut().zip(column).for_each(|(sum, &number)| *sum = *sum + number * factor);
        }
        result
    }

    /// The map twice in a row.
    fn squared(&self) -> Map {
        Map { columns: self.columns.iter().map(|column| self.apply(column)).collect() }
    }
}

impl Round<'_> {
    /// Skips as many rounds as surely go on as this one does, from these velocities (m/s) on; none if there are fewer
    /// than `fewest`.
    pub(super) fn skip(&self, velocities: &[DVec3], fewest: u64) -> Option<Skipped> {
        let mut numbers = self.numbers(velocities);
        let walk = Walk::new(self, &numbers);
        let mut powers = vec![Map::of_round(&walk, velocities.len())];
        let mut rounds = 0_u64;
        for _ in 0..MOST_SKIPS {
            let Some((end, more)) = walk.skip_once(&mut powers, &numbers) else { break };
            (numbers, rounds) = (end, rounds.saturating_add(more));
        }
        if rounds < fewest {
            return None;
        }
        let (v, sums) = numbers.split_at(3 * velocities.len());
        let value = |number: &Double| number.value();
        Some(Skipped {
            rounds,
            velocities: v.chunks(3).map(|v| DVec3::new(value(&v[0]), value(&v[1]), value(&v[2]))).collect(),
            approaches: sums.iter().map(value).collect(),
        })
    }

    /// The bystanders that approach in one round from these velocities (m/s) on, in the order in which they begin to.
    pub(super) fn met(&self, velocities: &[DVec3]) -> Vec<Met> {
        let fastest = self.fastest(velocities);
        let mut numbers = self.numbers(velocities);
        let mut found: Vec<Met> = Vec::new();
        for before in 0..=self.strikes.len() {
            for (bystander, contact) in self.bystanders.iter().enumerate() {
                let new = found.iter().all(|met| met.bystander != bystander);
                if new && approach_share(contact, &numbers) > self.rounding {
                    let speeds = fastest[contact.a] + contact.b.map_or(contact.velocity.length(), |b| fastest[b]);
                    let approach_speed = -opening(contact, &numbers);
                    found.push(Met { before, bystander, share: approach_speed / speeds, approach_speed });
                }
            }
            if let Some(impact) = self.strikes.get(before) {
                impact.act(&impact.direction(), &mut numbers);
            }
        }
        found
    }

    /// The fastest that each body is in one round from these velocities (m/s) on, m/s.
    fn fastest(&self, velocities: &[DVec3]) -> Vec<f64> {
        let mut numbers = self.numbers(velocities);
        let mut fastest: Vec<f64> = velocities.iter().map(|v| v.length()).collect();
        for impact in self.strikes {
            impact.act(&impact.direction(), &mut numbers);
            fastest.iter_mut().enumerate().for_each(|(body, fastest)| *fastest = fastest.max(speed(&numbers, body)));
        }
        fastest
    }

    /// Numbers of these velocities (m/s), and of no approaches yet.
    fn numbers(&self, velocities: &[DVec3]) -> Numbers {
        let mut numbers: Numbers = velocities.iter().flat_map(|v| v.to_array()).map(Double::from).collect();
        numbers.resize(numbers.len() + self.strikes.len(), Double::ZERO);
        numbers
    }
}

/// A round that is followed from some velocities on.
struct Walk<'a> {
    round: &'a Round<'a>,
    /// The direction of each impact.
    directions: Vec<[Double; 3]>,
    /// Approach speed of each impact up to which it is rounding, or none, m/s.
    least: Vec<f64>,
}

impl<'a> Walk<'a> {
    fn new(round: &'a Round<'a>, numbers: &Numbers) -> Walk<'a> {
        let directions: Vec<_> = round.strikes.iter().map(Strike::direction).collect();
        let mut numbers = numbers.clone();
        let mut least = Vec::with_capacity(directions.len());
        for (strike, direction) in round.strikes.iter().zip(&directions) {
            let speeds = speed(&numbers, strike.a) + strike.b.map_or(0.0, |b| speed(&numbers, b));
            least.push(strike.slowest.max(round.rounding * speeds));
            strike.act(direction, &mut numbers);
        }
        Walk { round, directions, least }
    }

    /// The longest skip in doubling steps that goes on as it begins, and its rounds; `powers` are the map of 1, 2, 4 …
    /// rounds as far as they are known.
    fn skip_once(&self, powers: &mut Vec<Map>, from: &Numbers) -> Option<(Numbers, u64)> {
        let before = self.approaches(from)?;
        let mut best = None;
        for k in 0..MOST_DOUBLINGS {
            if k == powers.len() {
                powers.push(powers[k - 1].squared());
            }
            let middle = powers[k].apply(from);
            let end = powers[k].apply(&middle);
            if !self.goes_on(&before, &middle) || !self.goes_on(&before, &end) {
                break;
            }
            best = Some((end, 2 << k));
        }
        best
    }

    /// Whether all approaches of the next rounds are between half and twice those `before`, m/s; within ten times where
    /// something beside the chain stops what grazes it: its first approach may be that of several rounds.
    fn goes_on(&self, before: &[f64], numbers: &Numbers) -> bool {
        let mut numbers = numbers.clone();
        (0..ROUNDS_AFTER).all(|_| {
            let Some(now) = self.approaches(&numbers) else { return false };
            self.act(&mut numbers);
            let most = self.round.strikes.iter().map(|strike| if strike.stops { 10.0 } else { 2.0 });
            before
                .iter()
                .zip(&now)
                .zip(most)
                .all(|((&before, &now), most)| now * most >= before && now <= most * before)
        })
    }

    /// By how much each approach of a round exceeds what is an impact, m/s; none if one does not, or something else that
    /// touches approaches.
    fn approaches(&self, numbers: &Numbers) -> Option<Vec<f64>> {
        let mut numbers = numbers.clone();
        let mut found = Vec::with_capacity(self.least.len());
        for ((strike, direction), least) in self.round.strikes.iter().zip(&self.directions).zip(&self.least) {
            let approach = strike.act(direction, &mut numbers).value();
            let mut beside = self.round.bystanders.iter();
            let is_met = |bystander: &Bystander| approach_share(bystander, &numbers) > bystander.most;
            if approach <= *least || approach > strike.fastest || beside.any(is_met) {
                return None;
            }
            found.push(approach - strike.slowest);
        }
        Some(found)
    }

    /// Does the impacts of one round.
    fn act(&self, numbers: &mut Numbers) {
        let sums = numbers.len() - self.directions.len();
        for (k, (strike, direction)) in self.round.strikes.iter().zip(&self.directions).enumerate() {
            let approach = strike.act(direction, numbers);
            numbers[sums + k] = numbers[sums + k] + approach;
        }
    }
}

/// How fast the bodies of a contact that is no impact of the round approach, as a share of their speeds; 0 if they stand.
fn approach_share(contact: &Bystander, numbers: &Numbers) -> f64 {
    let speeds = speed(numbers, contact.a) + contact.b.map_or(contact.velocity.length(), |b| speed(numbers, b));
    if speeds > 0.0 { -opening(contact, numbers) / speeds } else { 0.0 }
}

/// Normal velocity of a contact that is no impact of the round, m/s.
fn opening(contact: &Bystander, numbers: &Numbers) -> f64 {
    let other = contact.b.map_or(contact.velocity, |b| velocity(numbers, b));
    (velocity(numbers, contact.a) - other).dot(contact.normal)
}

fn velocity(numbers: &Numbers, body: usize) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|k| numbers[3 * body + k].value()))
}

fn speed(numbers: &Numbers, body: usize) -> f64 {
    velocity(numbers, body).length()
}
