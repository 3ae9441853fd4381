//! Tracers that drift with the fluid.

use motile::base::Vec2;
use motile_output::{Raster, Samples, Snapshot};

use crate::Refusal;

/// Mean life of a tracer, in visits.
const LIFE: u32 = 240;

/// Particles of dust that the flow carries, each for a while.
#[derive(Debug)]
pub struct Dust {
    places: Vec<Vec2>,
    /// Visits that each has left.
    left: Vec<u32>,
    /// State of the generator of places.
    seed: u64,
    flow: Option<(Raster, Samples<Vec2>)>,
    /// Size of the rectangle that they are in (length).
    size: Vec2,
}

impl Dust {
    /// So many tracers, which get places when there is a flow.
    #[must_use]
    pub fn new(count: usize) -> Self {
        Self { places: vec![Vec2::splat(f64::NAN); count], left: vec![0; count], seed: 1, flow: None, size: Vec2::ZERO }
    }

    /// Number from 0 to 1 (xorshift64*).
    fn random(&mut self) -> f64 {
        self.seed ^= self.seed >> 12;
        self.seed ^= self.seed << 25;
        self.seed ^= self.seed >> 27;
        (self.seed.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Takes over the flow of a state.
    ///
    /// # Errors
    /// None for a snapshot as it was taken.
    pub fn see(&mut self, seen: &Snapshot) -> Result<(), Refusal> {
        self.flow = Some((seen.raster, Samples::new(seen.raster, seen.velocity())?));
        Ok(())
    }

    /// Velocity of the fluid at a point (length per time), zero where it is not known: before a flow was seen, beyond
    /// walls and far away.
    #[must_use]
    pub fn velocity(&self, point: Vec2) -> Vec2 {
        let known = self.flow.as_ref().filter(|(raster, _)| raster.covers(point));
        known.map_or(Vec2::ZERO, |(_, flow)| flow.at(point))
    }

    /// Lets all drift for a while (time) by the midpoint rule within a rectangle (length), and gives those that have
    /// left it or grown old new places, all of them where it has another size.
    pub fn drift(&mut self, dt: f64, [low, high]: [Vec2; 2]) {
        let size = high - low;
        if (size - self.size).length() > 0.1 * size.length() {
            self.left.fill(0);
            self.size = size;
        }
        for k in 0..self.places.len() {
            let place = self.places[k];
            let middle = place + self.velocity(place) * (0.5 * dt);
            let next = place + self.velocity(middle) * dt;
            let within = next.x >= low.x && next.x <= high.x && next.y >= low.y && next.y <= high.y;
            if within && self.left[k] > 0 {
                self.left[k] -= 1;
                self.places[k] = next;
            } else {
                let (a, b) = (self.random(), self.random());
                self.places[k] = Vec2::new(low.x + a * (high.x - low.x), low.y + b * (high.y - low.y));
                self.left[k] = (self.random() * f64::from(2 * LIFE)) as u32;
            }
        }
    }

    /// Places (length) and velocities (length per time) of all, x, y, u and v of the first and so on.
    #[must_use]
    pub fn streaks(&self) -> Vec<f32> {
        let streak = |place: &Vec2| {
            let velocity = self.velocity(*place);
            [place.x, place.y, velocity.x, velocity.y].map(|value| value as f32)
        };
        self.places.iter().flat_map(streak).collect()
    }
}
