//! The fibre as a body of a scene.

use std::f64::consts::PI;
use std::ops::Range;

use motile_base::{Vec2, internal::Refuse};
use motile_scene::{
    Body, BodyError, FluidView, MarkerKind, StepLimit, Warning, checkpoint::SavedState, fastest_decay, points,
};

use super::{Fibre, FibreEnd};
use crate::SolidError;

/// Largest angle by which a fibre that resists bending may turn at a node (radians).
const SHARPEST_TURN: f64 = 0.9 * PI;
/// Distance of nodes over the grid spacing above which the fluid leaks between them.
const WIDEST: f64 = 1.5;
/// Errors on a grid over the grid spacing. The first is the error of the forces on a fibre, in units of its length. The
/// second is the error of the speed of a fibre along which waves travel, in units of the wave length. They were
/// measured for a hair on a wall with 6 to 24 spacings, and for Taylor's sheet with 16 to 32.
const THICKNESS: [f64; 2] = [0.7, 5.0];
/// Error that a run may have without a warning.
const ALLOWED: f64 = 0.01;

impl Fibre {
    /// Returns the nodes that move, which are the markers.
    fn free(&self) -> Range<usize> {
        let [first, last] = self.ends.map(|end| usize::from(end != FibreEnd::Free));
        first..self.nodes.len() - last
    }

    /// Returns the shortest segment (length).
    fn shortest(&self) -> f64 {
        let segments = 0..self.elasticity.lengths.len();
        segments.map(|k| self.elasticity.segment(&self.nodes, k).length()).fold(f64::INFINITY, f64::min)
    }

    /// Returns the fastest decay of waves on a straight line without ends, on a grid with the narrowest kernel
    /// (1/time). `None` without a grid, and for a fibre that is held, whose springs to what is held decay faster.
    ///
    /// With the grid spacing h, nodes at the distance l, and the modulus B, waves across the line decay at most at the
    /// rate `B/(eta h (0.58 h^2 + l^2))`. With the modulus S, waves along it decay at most at `0.14 S/(eta h)`. Both
    /// rates are fits from above of the largest eigenvalues on a staggered grid with the quadratic spline, for l/h from
    /// 0.1 to 5.
    fn fastest_wave(&self, view: &FluidView) -> Option<f64> {
        let h = view.spacing.filter(|_| self.ends == [FibreEnd::Free; 2] && self.targets.is_empty())?;
        let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        let springs = self.elasticity.stretches(&self.nodes).zip(&self.elasticity.stretching);
        let tension = most(&mut springs.map(|(stretch, modulus)| modulus * (stretch - 1.0).abs()));
        let stretching = most(&mut self.elasticity.stretching.iter().copied());
        let bending = most(&mut self.elasticity.bending.iter().copied()) / (0.58 * h * h + self.shortest().powi(2));
        let along = 0.14 * stretching;
        Some((along.max(bending) + 0.14 * tension) / (view.viscosity * h))
    }

    /// Returns the warning about a fibre that is as thick on the grid as two of its spacings, which is too much for its
    /// length and its waves.
    fn thickness_warning(&self, spacing: f64) -> Option<Warning> {
        let [by_length, by_wave] = THICKNESS;
        let wave = self.wave.map_or(0.0, |wave| by_wave * wave.numbers()[0].abs() / (2.0 * PI));
        let error = spacing * (by_length / self.rest_length()).max(wave);
        (error > ALLOWED).then(|| Warning {
            body: self.name.clone(),
            cause: "grid too coarse for a fibre".into(),
            excess: error / ALLOWED,
            message: format!(
                "on this grid, the fibre is about as thick as two grid spacings of {spacing:.3}, so that forces and \
                 speeds are off by about {:.0} %; halve the spacing of grid and nodes to halve the error",
                100.0 * error
            ),
        })
    }

    /// Returns the fastest decay of displacements (1/time), and the shortest segment for which it was found (length).
    fn fastest_decay(&self, view: &FluidView) -> [f64; 2] {
        self.decay.get().unwrap_or_else(|| {
            let free = self.free();
            let (mut nodes, mut all) = (self.nodes.clone(), self.forces.clone());
            let rate = fastest_decay(view, &self.nodes[free.clone()], |places, forces| {
                nodes[free.clone()].copy_from_slice(places);
                all.fill(Vec2::ZERO);
                self.add_forces(&nodes, &mut all);
                forces.copy_from_slice(&all[free.clone()]);
            });
            let found = [rate, self.shortest()];
            self.decay.set(Some(found));
            found
        })
    }
}

impl Body for Fibre {
    fn name(&self) -> &str {
        &self.name
    }

    fn kind(&self) -> MarkerKind {
        MarkerKind::Points
    }

    fn marker_count(&self) -> usize {
        self.free().len()
    }

    fn write_markers(&self, positions: &mut [Vec2]) {
        positions.copy_from_slice(&self.nodes[self.free()]);
    }

    fn write_forces(&mut self, _view: &FluidView, forces: &mut [Vec2]) -> Result<(), BodyError> {
        self.check_segments()?;
        let mut all = std::mem::take(&mut self.forces);
        all.fill(Vec2::ZERO);
        self.add_forces(&self.nodes, &mut all);
        forces.copy_from_slice(&all[self.free()]);
        self.forces = all;
        Ok(())
    }

    fn state_len(&self) -> usize {
        2 * self.free().len()
    }

    fn write_state(&self, state: &mut [f64]) {
        points::write(&self.nodes[self.free()], state);
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        let free = self.free();
        points::read(state, &mut self.nodes[free])
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        points::write(velocities, rate);
    }

    fn depends_on_time(&self) -> bool {
        self.wave.is_some_and(|wave| wave.frequency != 0.0) || self.targets.iter().any(super::Target::moves)
    }

    fn set_time(&mut self, time: f64) {
        self.time = time;
    }

    fn end_step(&mut self, _view: &FluidView, _dt: f64) -> Result<(), BodyError> {
        let stiff = |node: usize| self.elasticity.bending[node] > 0.0;
        match self.elasticity.angles(&self.nodes).find(|(node, angle)| stiff(*node) && angle.abs() > SHARPEST_TURN) {
            Some((node, angle)) => {
                let (x, y) = (self.nodes[node].x, self.nodes[node].y);
                let what = format!("{} folds onto itself at node {node} near ({x:.4}, {y:.4})", self.name);
                let value = format!("it turns by {:.0} degrees there", angle.to_degrees());
                let remedy = "Use a smaller time step, more nodes, or a larger bending modulus";
                Err(SolidError::refused(what, value, remedy).into())
            }
            None => Ok(()),
        }
    }

    /// Reports the decay of the fastest mode of all springs, hinges and targets, as [`fastest_decay`] estimates it once
    /// from above. If segments become shorter, the bound falls with the third power of their length. On a grid, a fibre
    /// that nothing holds decays no faster than waves on a straight line.
    fn step_limits(&self, view: &FluidView, limits: &mut dyn FnMut(StepLimit)) {
        let [rate, shortest] = self.fastest_decay(view);
        let rate = rate * (shortest / self.shortest()).max(1.0).powi(3);
        let rate = rate.min(self.fastest_wave(view).unwrap_or(f64::INFINITY));
        if rate > 0.0 {
            limits(StepLimit::decay(2.0 / rate, "the elasticity"));
        }
    }

    fn warnings(&self, view: &FluidView) -> Vec<Warning> {
        let Some(spacing) = view.spacing else { return Vec::new() };
        let segments = 0..self.elasticity.lengths.len();
        let widest = segments.map(|k| self.elasticity.segment(&self.nodes, k).length()).fold(0.0, f64::max);
        let leak = widest / (WIDEST * spacing);
        let leak = (leak > 1.0).then(|| {
            let message = format!(
                "two nodes are {widest:.3} apart, more than {WIDEST} grid spacings: the fluid leaks between them; use \
                 more nodes or a coarser grid"
            );
            Warning { body: self.name.clone(), cause: "nodes of a fibre too far apart".into(), excess: leak, message }
        });
        leak.into_iter().chain(self.thickness_warning(spacing)).collect()
    }

    fn write_scales(&self, scales: &mut [f64]) {
        scales.fill(self.rest_length());
    }

    /// Not of fibres with targets that move or curvature at rest, which the mirror image has with the other sign.
    fn mirror(&self, markers: &[usize], state: &[f64], image: &mut [f64]) -> bool {
        points::mirror(markers, state, image);
        self.wave.is_none() && !self.targets.iter().any(super::Target::moves)
    }

    /// Only of a fibre that nothing holds.
    fn translate(&self, by: Vec2, state: &mut [f64]) -> bool {
        points::translate(by, state);
        self.ends == [FibreEnd::Free; 2] && self.targets.is_empty()
    }

    fn properties(&self) -> Vec<(String, f64)> {
        let sum = |values: &[f64]| values.iter().sum::<f64>();
        let stiffness = self.targets.iter().map(|target| target.stiffness).sum();
        let loads = self.loads.iter().map(|(_, load)| *load).sum::<Vec2>();
        let mut properties = vec![
            ("the number of nodes", self.nodes.len() as f64),
            ("the number of nodes that move", self.free().len() as f64),
            ("the length at rest", self.rest_length()),
            ("the sum of the stretching moduli", sum(&self.elasticity.stretching)),
            ("the sum of the bending moduli", sum(&self.elasticity.bending)),
            ("the sum of the squared curvatures at rest", self.elasticity.curvatures.iter().map(|k| k * k).sum()),
            ("the number of targets", self.targets.len() as f64),
            ("the sum of the stiffnesses of the targets", stiffness),
            ("the load along x", loads.x),
            ("the load along y", loads.y),
        ];
        if let Some(wave) = &self.wave {
            let [number, frequency, phase] = wave.numbers();
            properties.extend([
                ("the amplitude of the wave", wave.amplitude),
                ("the wave number", number),
                ("the frequency of the wave", frequency),
                ("the phase of the wave", phase),
            ]);
        }
        properties.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
    }

    /// Returns the positions of all nodes, held ones among them, the time, and the fastest decay if it is known.
    fn save(&self) -> SavedState {
        let mut reals = vec![0.0; 2 * self.nodes.len()];
        points::write(&self.nodes, &mut reals);
        let known = self.decay.get();
        reals.extend(known.unwrap_or_default());
        reals.push(self.time);
        SavedState { reals, counts: vec![u64::from(known.is_some())] }
    }

    fn load(&mut self, _view: &FluidView, saved: &SavedState) -> Result<(), BodyError> {
        let [known] = saved.counts_of()?;
        let (places, rest) = saved.reals_of(2 * self.nodes.len() + 3)?.split_at(2 * self.nodes.len());
        points::read(places, &mut self.nodes)?;
        self.decay.set((known > 0).then_some([rest[0], rest[1]]));
        self.time = rest[2];
        Ok(())
    }
}
