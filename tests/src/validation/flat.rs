//! Waves on flat interfaces that are periodic along x, against linear theory.

use std::f64::consts::TAU;

use motile::active_interface::{
    ActiveInterface, ContractileTension, ExcludedVolume, InitialConcentration,
    theory::{FlatInterface, Stratum, StratumEnd},
    wave,
};
use motile::base::Region;
use motile::boundary_integrals::{BoundaryIntegral, Settings};
use motile::scene::{Body, Hydrodynamics, Markers, StepInfo};

use super::StudyError;

/// Period of the region (length).
pub const PERIOD: f64 = 6.0;
const C0: f64 = 100.0;
const GAMMA0: f64 = 10.0;
const ACTIVITY: f64 = -0.05;
const DIFFUSION: f64 = 0.1;

/// Flat interfaces of contractile particles with waves on them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flat<'a> {
    /// The region, of period [`PERIOD`].
    pub region: Region,
    /// Viscosity of the exterior fluid (stress times time).
    pub exterior: f64,
    /// Height (length), advance (length) and viscosity inside (stress times time) of each interface.
    pub interfaces: &'a [(f64, f64, f64)],
    /// Signs of the perturbations of concentration and height on each.
    pub signs: &'a [[f64; 2]],
    /// Number of waves in a period.
    pub waves: usize,
}

impl Flat<'_> {
    /// The matrix of growth of the last interface, by small perturbations of concentration and height.
    ///
    /// # Errors
    /// A scene that cannot be computed.
    pub fn growth(&self, nodes: usize, elements: usize) -> Result<[[f64; 2]; 2], StudyError> {
        let (c, h) = (1e-5 * C0, 1e-6);
        let [by_c, by_h] = [self.rate([c, 0.0], nodes, elements)?, self.rate([0.0, h], nodes, elements)?];
        Ok([[by_c[0] / c, by_h[0] / h], [by_c[1] / c, by_h[1] / h]])
    }

    fn rate(&self, [c, h]: [f64; 2], nodes: usize, elements: usize) -> Result<[f64; 2], StudyError> {
        let settings = Settings { nodes, tolerance: 1e-12, ..Settings::default() };
        let mut flow = BoundaryIntegral::new(self.region, self.exterior, settings)?;
        let view = flow.fluid_view();
        let k = TAU * self.waves as f64 / PERIOD;
        let law = ContractileTension::new(GAMMA0, ACTIVITY, ExcludedVolume::None, 1.0)?;
        let bodies: Result<Vec<ActiveInterface>, StudyError> = self
            .interfaces
            .iter()
            .zip(self.signs)
            .map(|(&(height, advance, viscosity), &[sign_c, sign_h])| -> Result<_, StudyError> {
                let mut amplitudes = vec![0.0; self.waves];
                amplitudes[self.waves - 1] = sign_h * h;
                let markers = wave(height, advance, &amplitudes, &[], elements)?;
                let concentration = move |t: f64| C0 + sign_c * c * (k * PERIOD * (t - 0.5)).cos();
                let initial = InitialConcentration::by_arc_fraction(concentration);
                let numbers = initial.particle_numbers_over(&markers, advance)?;
                let body = ActiveInterface::periodic(&markers, advance, numbers, law, DIFFUSION)?;
                Ok(body.with_viscosity_inside(viscosity)?)
            })
            .collect();
        let mut bodies = bodies?;
        let mut markers = Markers::new();
        for body in &bodies {
            markers.push_group(elements, body.kind());
        }
        for (index, body) in bodies.iter_mut().enumerate() {
            let range = index * elements..(index + 1) * elements;
            body.write_markers(&mut markers.positions_mut()[range.clone()]);
            body.write_forces(&view, &mut markers.forces_mut()[range])?;
        }
        flow.velocities(&mut markers)?;
        let index = bodies.len() - 1;
        let body = &mut bodies[index];
        let mut rate = vec![0.0; body.state_len()];
        body.rate(&markers.velocities()[index * elements..], &mut rate);
        let lengths = body.element_lengths().to_vec();
        let mut state = vec![0.0; body.state_len()];
        body.write_state(&mut state);
        let (positions, numbers) = rate.split_at(2 * elements);
        let mut change = numbers.to_vec();
        body.begin_step(&view, StepInfo { dt: 1.0, stabilised: false })?;
        let mut implicit = vec![0.0; body.state_len()];
        body.add_implicit(&state, 1.0, &mut implicit);
        change.iter_mut().zip(&implicit[2 * elements..]).for_each(|(change, more)| *change += more);
        let advance = body.advance();
        let along = |t: f64| (k * advance * (t - 0.5)).cos();
        let count = elements as f64;
        let dc = (0..elements).map(|i| change[i] / lengths[i] * along((i as f64 + 0.5) / count)).sum::<f64>();
        let dh = (0..elements).map(|i| positions[2 * i + 1] * along(i as f64 / count)).sum::<f64>();
        Ok([2.0 * dc / count, 2.0 * dh / count])
    }

    /// The matrix of growth by the linear theory, between fluids below and above the last interface.
    ///
    /// # Errors
    /// Fluids that there are not.
    pub fn theory(&self, below: Stratum, above: Stratum) -> Result<[[f64; 2]; 2], StudyError> {
        let k = TAU * self.waves as f64 / PERIOD;
        let interface = FlatInterface {
            wave_number: k,
            tension: GAMMA0 - ACTIVITY * C0,
            activity: ACTIVITY,
            concentration: C0,
            diffusivity: DIFFUSION,
        };
        Ok(interface.growth_matrix(below, above)?)
    }
}

/// Largest difference of two matrices over the largest entry, in units in which c and h are comparable.
#[must_use]
pub fn difference(found: [[f64; 2]; 2], exact: [[f64; 2]; 2]) -> f64 {
    let scaled = |m: [[f64; 2]; 2]| [m[0][0], m[0][1] / C0, m[1][0] * C0, m[1][1]];
    let (found, exact) = (scaled(found), scaled(exact));
    let scale = exact.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    found.iter().zip(exact).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs())) / scale
}

/// A half-space of fluid of that viscosity (stress times time).
#[must_use]
pub fn half_space(viscosity: f64) -> Stratum {
    Stratum { viscosity, end: StratumEnd::None }
}

/// Fluid of that viscosity (stress times time) up to a rigid wall so far away (length).
#[must_use]
pub fn wall(viscosity: f64, thickness: f64) -> Stratum {
    Stratum { viscosity, end: StratumEnd::Wall { thickness } }
}
