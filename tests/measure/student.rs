//! A student's program: the paper's method written from its formulas alone, with no code of Carom's, and each of nine mistakes
//! on demand. It writes a row per sphere and frame.

use std::collections::BTreeMap;
use std::fmt::Write;

use carom::marks::Mistake;
use carom::scene::{ContactLaw, Scene};
use glam::DVec3;

/// Sphere, and wall or second sphere after all walls.
type Key = (usize, usize);

struct Ball {
    x: DVec3,
    v: DVec3,
    m: f64,
    r: f64,
    pull: DVec3,
}

/// A contact: its bodies, its degree and its unit normal towards the first.
struct Meeting {
    key: Key,
    degree: f64,
    normal: DVec3,
}

/// The program on its way.
pub(crate) struct Student {
    balls: Vec<Ball>,
    walls: Vec<[DVec3; 3]>,
    law: ContactLaw,
    dt: f64,
    /// The degree up to which an overlap is accepted, the paper's slack included; it goes with dt, as the error of a step does.
    tolerance: f64,
    mistake: Option<Mistake>,
    /// Changes of velocity that act in the next frame, and in the one after.
    kicks: [BTreeMap<Key, Vec<(usize, DVec3)>>; 2],
    /// What contacts take of the pull in the next frame.
    support: Vec<DVec3>,
}

fn nearest(wall: &[DVec3; 3], p: DVec3) -> DVec3 {
    // The closest point of a rectangle or slanted parallelogram: its face, or clamped edges.
    let [center, s1, s2] = *wall;
    let corner = center - (s1 + s2) * 0.5;
    let (a, b, c) = (s1.dot(s1), s1.dot(s2), s2.dot(s2));
    let (d, e) = (s1.dot(p - corner), s2.dot(p - corner));
    let det = a * c - b * b;
    let (u, w) = ((d * c - e * b) / det, (e * a - d * b) / det);
    if (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&w) {
        return corner + s1 * u + s2 * w;
    }
    let on = |from: DVec3, along: DVec3| from + along * ((p - from).dot(along) / along.dot(along)).clamp(0.0, 1.0);
    let edges = [on(corner, s1), on(corner, s2), on(corner + s2, s1), on(corner + s1, s2)];
    edges.into_iter().min_by(|one, other| one.distance(p).total_cmp(&other.distance(p))).expect("four edges")
}

impl Student {
    pub(crate) fn new(scene: &Scene, dt: f64, mistake: Option<Mistake>) -> Student {
        let ball = |s: &carom::scene::Sphere| Ball {
            x: s.x,
            v: s.v,
            m: s.mass,
            r: s.radius,
            pull: scene.gravity + s.force / s.mass,
        };
        let balls: Vec<Ball> = scene.spheres.iter().map(ball).collect();
        Student {
            support: vec![DVec3::ZERO; balls.len()],
            balls,
            walls: scene.walls.iter().map(|wall| [wall.shape.center, wall.shape.s1, wall.shape.s2]).collect(),
            law: scene.contact,
            dt,
            tolerance: 0.11 * dt,
            mistake,
            kicks: [BTreeMap::new(), BTreeMap::new()],
        }
    }

    fn has(&self, mistake: Mistake) -> bool {
        self.mistake == Some(mistake)
    }

    /// All that touch at these places.
    fn meetings(&self, x: &[DVec3]) -> Vec<Meeting> {
        let mut found = Vec::new();
        for (a, ball) in self.balls.iter().enumerate() {
            for (w, wall) in self.walls.iter().enumerate() {
                let arm = x[a] - nearest(wall, x[a]);
                let degree = 1.0 - arm.length() / ball.r;
                let mut normal = arm.normalize();
                let front = wall[1].cross(wall[2]).normalize();
                if self.has(Mistake::NormalAtTheBack) && normal.dot(front) < 0.0 {
                    normal = -normal;
                }
                if degree > 0.0 {
                    found.push(Meeting { key: (a, w), degree, normal });
                }
            }
            for (b, other) in self.balls.iter().enumerate().skip(a + 1) {
                let arm = x[a] - x[b];
                let degree = 1.0 - arm.length() / (ball.r + other.r);
                if degree > 0.0 {
                    found.push(Meeting { key: (a, self.walls.len() + b), degree, normal: arm.normalize() });
                }
            }
        }
        found
    }

    /// Where all are after `h` seconds of this frame.
    fn after(&self, h: f64) -> Vec<DVec3> {
        let place = |(i, ball): (usize, &Ball)| ball.x + (ball.v + (ball.pull + self.support[i]) * h) * h;
        self.balls.iter().enumerate().map(place).collect()
    }

    /// One frame; how long it was, s.
    fn frame(&mut self) -> f64 {
        let [now, later] = std::mem::take(&mut self.kicks);
        for (i, change) in now.into_values().flatten() {
            self.balls[i].v += change;
        }
        self.kicks[0] = later;
        let h = self.length();
        let x = self.after(h);
        for (i, ball) in self.balls.iter_mut().enumerate() {
            ball.v += (ball.pull + self.support[i]) * h;
            ball.x = x[i];
        }
        self.support.fill(DVec3::ZERO);
        self.meetings(&x).iter().for_each(|meeting| self.answer(meeting));
        h
    }

    /// The whole step, or as much of it as brings the first contact within the tolerance.
    fn length(&self) -> f64 {
        let deepest = |h: f64| self.meetings(&self.after(h)).iter().map(|m| m.degree).fold(0.0, f64::max);
        if self.has(Mistake::Tunnelling) && deepest(self.dt) == 0.0 {
            return self.dt;
        }
        let most = self.tolerance;
        if deepest(self.dt) <= most {
            return self.dt;
        }
        let (mut low, mut high) = (0.0, self.dt);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            match deepest(middle) {
                degree if degree > most => high = middle,
                degree if degree > 0.0 => return middle,
                _ => low = middle,
            }
        }
        self.dt // already deep at its start: on it goes
    }

    fn answer(&mut self, meeting: &Meeting) {
        let (a, other) = meeting.key;
        let pair = other.checked_sub(self.walls.len());
        let n = meeting.normal;
        let v = self.balls[a].v - pair.map_or(DVec3::ZERO, |b| self.balls[b].v);
        let v_n = v.dot(n);
        if pair.is_none() && self.has(Mistake::Projected) {
            let deep = meeting.degree * self.balls[a].r;
            self.balls[a].x += n * deep;
        }
        if pair.is_none() && self.has(Mistake::TangentialEveryFrame) && v_n.abs() <= self.law.rest_speed {
            let tangential = v - n * v_n;
            self.balls[a].v -= tangential * (1.0 - self.law.tangential);
        }
        let swapped = self.has(Mistake::ThresholdsSwapped);
        let (leaves, collides) = if swapped {
            (v_n <= -self.law.rest_speed, v_n > self.law.rest_speed)
        } else {
            (v_n > self.law.rest_speed, v_n <= -self.law.rest_speed)
        };
        match pair {
            _ if leaves => {}
            _ if collides => self.collide(meeting, pair, v),
            None => self.rest(a, n, v_n),
            Some(_) => {}
        }
    }

    fn rest(&mut self, a: usize, n: DVec3, v_n: f64) {
        let ball = &mut self.balls[a];
        if self.mistake != Some(Mistake::RestingSpeedKept) {
            ball.v -= n * v_n;
        }
        self.support[a] -= n * ball.pull.dot(n).min(0.0);
    }

    fn collide(&mut self, meeting: &Meeting, pair: Option<usize>, v: DVec3) {
        let (a, n) = (meeting.key.0, meeting.normal);
        let v_n = v.dot(n);
        let changes = match pair {
            None => {
                let tangential = v - n * v_n;
                vec![(a, -n * ((1.0 + self.law.wall_restitution) * v_n) - tangential * (1.0 - self.law.tangential))]
            }
            Some(b) => {
                let (m, w) = (self.balls[a].m, self.balls[b].m);
                let mut impulse = -n * ((1.0 + self.law.restitution) * v_n / (1.0 / m + 1.0 / w));
                if self.has(Mistake::PairTwice) {
                    impulse *= 2.0;
                }
                if self.has(Mistake::PairHalf) {
                    impulse *= 0.5;
                }
                vec![(a, impulse / m), (b, -impulse / w)]
            }
        };
        let late = usize::from(self.has(Mistake::OneStepLate));
        let waits = self.kicks.iter().any(|kicks| kicks.contains_key(&meeting.key));
        if !waits {
            self.kicks[late].insert(meeting.key, changes);
        }
    }

    /// Runs to `until` (s) or through so many frames, and writes every one.
    pub(crate) fn rows(mut self, until: f64, frames: usize) -> String {
        let mut text = String::from("time,sphere,x,y,z,vx,vy,vz\n");
        let mut t = 0.0;
        for _ in 0..frames {
            for (i, Ball { x, v, .. }) in self.balls.iter().enumerate() {
                writeln!(text, "{t:?},{i},{:?},{:?},{:?},{:?},{:?},{:?}", x.x, x.y, x.z, v.x, v.y, v.z)
                    .expect("memory");
            }
            if t >= until {
                break;
            }
            t += self.frame();
        }
        text
    }
}
