//! Which waves of a tube are taken: the rule for wave numbers, and orders around the axis.

use motile_base::internal::{Refuse, gauss_legendre};

use super::wall::{Answer, answers};
use crate::SpaceError;

/// Wave numbers at which a survey looks, in units of 1/radius: the first, and the ratio of the next ones.
const FIRST: f64 = 1.0;
const RATIO: f64 = std::f64::consts::SQRT_2;
/// Most orders and largest wave number: a droplet that needs more is a few thousandths of a radius from the wall.
const MOST_ORDERS: usize = 512;
const LARGEST: f64 = 600.0;
/// Rules that are kept: forces and the iterations for another viscosity need different ones.
const MOST_RULES: usize = 64;
/// Longest distance of droplets along the tube, in units of its radius.
const LONGEST: f64 = 400.0;
/// Ends of the pieces of the rule, which resolve the logarithms at zero and the poles close to the axis.
const PIECES: [f64; 2] = [1.0, 6.0];

/// A wave number, its weight, and the wall's answers.
#[derive(Debug, Clone)]
pub(super) struct Node {
    pub(super) k: f64,
    pub(super) weight: f64,
    pub(super) answers: Vec<Answer>,
}

impl Node {
    fn new(k: f64, weight: f64, orders: usize) -> Result<Self, SpaceError> {
        let answers = answers(k, orders + 2).ok_or_else(too_close)?;
        Ok(Self { k, weight, answers })
    }
}

fn too_close() -> SpaceError {
    let what = "a droplet is too close to the wall of the tube to be resolved";
    SpaceError::refused(what, "", "Use a wider tube or a smaller droplet, or move it away from the wall")
}

/// Extent along the axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reach(f64, f64);

impl Default for Reach {
    fn default() -> Self {
        Self(f64::INFINITY, -f64::INFINITY)
    }
}

impl Reach {
    pub(super) fn add(&mut self, z: f64) {
        *self = Self(self.0.min(z), self.1.max(z));
    }

    pub(super) fn middle(&self) -> f64 {
        if self.0 <= self.1 { 0.5 * (self.0 + self.1) } else { 0.0 }
    }

    pub(super) fn length(&self) -> f64 {
        (self.1 - self.0).max(0.0)
    }
}

/// Rules that were made, to use them again.
#[derive(Debug, Clone, Default)]
pub(super) struct Rules {
    ladder: Vec<Node>,
    kept: Vec<Rule>,
    /// The rule that is replaced next, if there are many.
    next: usize,
}

/// Nodes, with the end and the length of the rule, in steps, its orders, and the fewest nodes of a piece.
#[derive(Debug, Clone, Default)]
struct Rule {
    key: (usize, usize, usize, usize),
    nodes: Vec<Node>,
}

/// Which waves count for some sources.
#[derive(Debug, Clone, Default)]
pub(super) struct Survey {
    /// Wave numbers that were tried, with the orders that count.
    tried: Vec<(f64, usize)>,
    end: f64,
    list: Vec<f64>,
}

impl Survey {
    /// Tries shorter and shorter waves until a part of the velocities is left, with a function that writes the work of
    /// the wall for so many orders of a node. Returns false if there is no work at all.
    pub(super) fn update(
        &mut self,
        rules: &mut Rules,
        tolerance: f64,
        mut energies: impl FnMut(&Node, usize, &mut Vec<f64>),
    ) -> Result<bool, SpaceError> {
        // Work goes with the square of velocities.
        let negligible = tolerance.powi(2);
        let Self { tried, end, list } = self;
        tried.clear();
        let (mut guess, mut reference) = (12, 0.0_f64);
        let (mut k, mut before) = (FIRST, 0.0);
        for step in 0.. {
            let total = loop {
                let node = rules.step(step, k, guess)?;
                energies(node, guess, list);
                let total = list.iter().sum::<f64>();
                if total.is_nan() {
                    return Err(too_close());
                }
                let floor = negligible * reference.max(total);
                if list[guess - 2..].iter().all(|energy| *energy <= floor) {
                    let used = list.iter().rposition(|energy| *energy > floor).map_or(1, |last| last + 2);
                    tried.push((k, used));
                    guess = used + 2;
                    break total;
                }
                if guess >= MOST_ORDERS {
                    return Err(too_close());
                }
                guess = (guess + guess / 2).min(MOST_ORDERS);
            };
            reference = reference.max(total);
            if reference == 0.0 {
                return Ok(false);
            }
            let floor = negligible * reference;
            if total <= floor {
                // Between the last two, the logarithm falls along a line.
                let part = (f64::ln(before / floor) / f64::ln(before / total.max(1e-3 * floor))).clamp(0.0, 1.0);
                *end = if part.is_nan() { k } else { k / RATIO * RATIO.powf(part) };
                return Ok(true);
            }
            before = total;
            k *= RATIO;
            if k > LARGEST {
                return Err(too_close());
            }
        }
        Ok(false)
    }

    /// Returns the number of orders at a wave number.
    pub(super) fn orders(&self, k: f64) -> usize {
        let next = self.tried.partition_point(|tried| tried.0 < k);
        let most = |at: usize| self.tried.get(at).map_or(1, |tried| tried.1);
        most(next).max(most(next.saturating_sub(1)))
    }
}

impl Rules {
    /// Returns a node of the survey.
    fn step(&mut self, step: usize, k: f64, orders: usize) -> Result<&Node, SpaceError> {
        if step == self.ladder.len() {
            self.ladder.push(Node::new(k, 0.0, orders)?);
        } else if self.ladder[step].answers.len() < orders + 2 {
            self.ladder[step] = Node::new(k, 0.0, orders)?;
        }
        Ok(&self.ladder[step])
    }

    /// Returns the rule for a survey, an extent along the axis, and the part of the velocities that may be left out.
    pub(super) fn nodes(&mut self, survey: &Survey, length: f64, tolerance: f64) -> Result<&[Node], SpaceError> {
        if length > LONGEST {
            let what = "droplets, or the points where their flow is asked for, are too far apart along the tube";
            let value = format!("{length:.0} of its radii");
            return Err(SpaceError::refused(what, value, format!("Use at most {LONGEST} radii")));
        }
        let orders = survey.tried.iter().map(|tried| tried.1).max().unwrap_or(1);
        let fewest = 5 + (-1.6 * tolerance.min(1e-5).log10()).ceil() as usize;
        let (end, length) = ((survey.end / 2.0).ceil() as usize, (4.0 * length).ceil() as usize);
        let key = (end, length, orders.next_multiple_of(8), fewest);
        let known = self.kept.iter().position(|rule| rule.key == key);
        let place = known.unwrap_or(self.next);
        if known.is_none() {
            self.next = (place + 1) % MOST_RULES;
            if place == self.kept.len() {
                self.kept.push(Rule::default());
            }
            // A rule that fails half-way has no key.
            let mut nodes = std::mem::take(&mut self.kept[place]).nodes;
            nodes.clear();
            let (end, length) = (2.0 * key.0 as f64, 0.25 * key.1 as f64);
            let mut start = 0.0;
            for stop in PIECES.into_iter().map(|stop| stop.min(end)).chain([end]) {
                if stop > start {
                    add_piece([start, stop], length, key, &mut nodes)?;
                    start = stop;
                }
            }
            self.kept[place] = Rule { key, nodes };
        }
        Ok(&self.kept[place].nodes)
    }
}

/// Adds the nodes of a piece for the orders and the fewest nodes of a key.
fn add_piece(
    [start, stop]: [f64; 2],
    length: f64,
    (_, _, orders, fewest): (usize, usize, usize, usize),
    nodes: &mut Vec<Node>,
) -> Result<(), SpaceError> {
    let width = stop - start;
    // Waves turn by width * length; near zero, k = t^4.
    let power = if start == 0.0 { 4 } else { 1 };
    let count = fewest + (0.25 * width * length * f64::from(power)).ceil() as usize;
    for (x, weight) in gauss_legendre(count) {
        let t = 0.5 * (1.0 + x);
        let k = start + width * t.powi(power);
        let weight = 0.5 * weight * width * f64::from(power) * t.powi(power - 1);
        nodes.push(Node::new(k, weight, orders)?);
    }
    Ok(())
}
