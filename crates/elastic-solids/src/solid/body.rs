//! The solid as a body of a scene.

use ib_core::{
    Body, BodyError, Discretisation, MarkerKind, Vec2, body::StepLimit, checkpoint::SavedState, gap::Boundary,
    hydrodynamics::SurfaceCurve, input::same_length,
};

use crate::{Solid, SolidError, skin::Skin};

impl From<SolidError> for BodyError {
    fn from(error: SolidError) -> Self {
        Self::Other(Box::new(error))
    }
}

/// Part of the bulk modulus that adds to the stiffness of a mesh as coarse as the grid, growing with the square of the
/// mesh spacing. The velocity of the fluid has no divergence, so that the bulk modulus only acts through the error of
/// the linear interpolation in each triangle. Measured with the cubic and quadratic kernel, kappa = 20 mu: 0.003,
/// 0.012, 0.02 and 0.05 at mesh spacings of 0.5, 1, 1.5 and 2 grid spacings.
const BULK_SHARE: f64 = 0.015;

impl Body for Solid {
    fn name(&self) -> &str {
        &self.name
    }

    fn kind(&self) -> MarkerKind {
        MarkerKind::Points
    }

    fn marker_count(&self) -> usize {
        self.free.len()
    }

    fn write_markers(&self, positions: &mut [Vec2]) {
        for (marker, &point) in positions.iter_mut().zip(&self.free) {
            *marker = self.positions[point];
        }
    }

    fn write_forces(&mut self, _medium: &Discretisation, forces: &mut [Vec2]) -> Result<(), BodyError> {
        self.compute_forces()?;
        for (force, &point) in forces.iter_mut().zip(&self.free) {
            *force = self.forces[point];
        }
        Ok(())
    }

    fn state_len(&self) -> usize {
        2 * self.free.len()
    }

    fn write_state(&self, state: &mut [f64]) {
        for (pair, &point) in state.chunks_exact_mut(2).zip(&self.free) {
            pair.copy_from_slice(&self.positions[point].to_array());
        }
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        if let Some(index) = state.iter().position(|value| !value.is_finite()) {
            return Err(BodyError::NonFinite { what: "point coordinate", index, value: state[index] });
        }
        for (pair, &point) in state.chunks_exact(2).zip(&self.free) {
            self.positions[point] = Vec2::new(pair[0], pair[1]);
        }
        Ok(())
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        for (pair, velocity) in rate.chunks_exact_mut(2).zip(velocities) {
            pair.copy_from_slice(&velocity.to_array());
        }
    }

    fn end_step(&mut self, _medium: &Discretisation, _dt: f64) -> Result<(), BodyError> {
        if self.may_invert { Ok(()) } else { Ok(self.check_inversion()?) }
    }

    /// Its whole surface, pinned points too.
    fn write_boundary(&self, _markers: &[Vec2], boundary: &mut Boundary) {
        let period = self.mesh.period();
        for outline in self.mesh.boundary_loops() {
            let points = &outline.points;
            for (&start, &end) in points.iter().zip(points.iter().cycle().skip(1)) {
                let mut along = self.positions[end] - self.positions[start];
                if let Some(period) = period {
                    along.x -= period * (along.x / period).round();
                }
                boundary.push(self.positions[start], self.positions[start] + along);
            }
        }
    }

    /// The loops of the boundary without pinned points.
    fn surfaces(&self) -> Vec<SurfaceCurve> {
        let places = self.mesh.points();
        let mut surfaces = Vec::new();
        for outline in self.mesh.boundary_loops() {
            // Reference places decide, so that the deformation cannot change the image.
            let (mut shift, mut last) = (0, places[outline.points[0]].x);
            let markers = outline.points.iter().map(|point| {
                let x = places[*point].x;
                shift -= self.mesh.period().map_or(0, |period| ((x - last) / period).round() as i32);
                last = x;
                self.free.binary_search(point).map(|marker| (marker, shift))
            });
            if let Ok(markers) = markers.collect() {
                surfaces.push(SurfaceCurve { markers, periods: outline.periods });
            }
        }
        surfaces
    }

    /// The mesh at rest, and what it takes to shear and stretch it.
    fn properties(&self) -> Vec<(String, f64)> {
        let mesh = &self.mesh;
        let strained: Vec<Vec2> = mesh.points().iter().map(|s| Vec2::new(s.x + 0.1 * s.y, 1.05 * s.y)).collect();
        let triangles = mesh.areas().iter().enumerate();
        let properties = [
            ("the number of points", self.positions.len() as f64),
            ("the number of triangles", mesh.triangles().len() as f64),
            ("the area at rest", mesh.area()),
            ("the polar moment of area at rest", triangles.map(|(k, a)| a * mesh.centroid(k).length_squared()).sum()),
            ("the number of free points", self.free.len() as f64),
            ("the number of tethers", self.tethers.len() as f64),
            ("the energy of a shear of 0.1 and a stretch of 1.05", self.law.energy(&strained).unwrap_or(f64::NAN)),
            ("the energy of its skin there", self.skin.as_ref().map_or(0.0, |skin| skin.energy(&strained))),
        ];
        properties.map(|(name, value)| (name.to_owned(), value)).to_vec()
    }

    /// All points, pinned ones too, and the tethers.
    fn save(&self) -> SavedState {
        let mut reals: Vec<f64> = self.positions.iter().flat_map(|place| [place.x, place.y]).collect();
        reals.extend(self.tethers.iter().flat_map(|tether| [tether.anchor.x, tether.anchor.y, tether.stiffness]));
        let counts = vec![self.positions.len() as u64, self.tethers.len() as u64];
        SavedState { reals, counts }
    }

    fn load(&mut self, _medium: &Discretisation, saved: &SavedState) -> Result<(), BodyError> {
        let [points, _] = saved.counts_of()?;
        same_length("a saved solid", self.positions.len(), points as usize)?;
        let split = 2 * self.positions.len();
        let (positions, numbers) = saved.reals_of(split + 3 * self.tethers.len())?.split_at(split);
        for (place, pair) in self.positions.iter_mut().zip(positions.chunks_exact(2)) {
            *place = Vec2::from_slice(pair);
        }
        for (tether, numbers) in self.tethers.iter_mut().zip(numbers.chunks_exact(3)) {
            tether.anchor = Vec2::new(numbers[0], numbers[1]);
            tether.stiffness = numbers[2];
        }
        Ok(())
    }

    /// `2 eta/(mu + 0.015 kappa (a/h)^2)` for the midpoint rule, a being the spacing of the mesh and h that of the
    /// grid; of the moduli the largest in the solid. A skin adds to the sum what its shortest waves take, tethers
    /// what holding all of them together in the slowest flow of the domain takes.
    fn step_limits(&self, discretisation: &Discretisation, limits: &mut dyn FnMut(StepLimit)) {
        let moduli = self.law.stiffest();
        let coarseness = discretisation.spacing.map_or(0.0, |spacing| self.spacing / spacing);
        let skin = self.skin.as_ref().map_or(0.0, Skin::stiffness);
        let elastic = moduli.shear() + BULK_SHARE * moduli.bulk() * coarseness * coarseness + skin;
        let (stiffness, reason) = if self.tethers.is_empty() {
            (elastic, "the elastic moduli")
        } else {
            (elastic + self.tether_stiffness(discretisation), "the elastic moduli and tethers")
        };
        limits(StepLimit::decay(2.0 * discretisation.viscosity / stiffness, reason));
    }
}

impl Solid {
    /// Viscosity times the fastest rate at which tethers relax (force per length), from above: all of them move
    /// together.
    ///
    /// A row of total stiffness k per length along a channel of height H relaxes at `k H/(4 eta)`, a layer that fills
    /// it at `k H/(pi^2 eta)`, one of thickness t in the middle at `k (H/4 - 0.148 t)/eta` (to 4 per cent); without
    /// walls a row in a box of length L at `k L/(12 eta)`. A group shorter than half of H or L moves no more easily
    /// than one of that length.
    fn tether_stiffness(&self, discretisation: &Discretisation) -> f64 {
        let anchors = || self.tethers.iter().map(|tether| tether.anchor);
        let first = self.tethers[0].anchor;
        let (low, high) = anchors().fold((first, first), |(a, b), p| (a.min(p), b.max(p)));
        let size = (high - low) + Vec2::splat(self.spacing);
        let (length, thickness) = (size.x.max(size.y), size.x.min(size.y));
        let domain = &discretisation.domain;
        let (reach, mobility) = match domain.walls {
            Some([bottom, top]) => (top - bottom, 0.25 * (top - bottom) - 0.148 * thickness.min(top - bottom)),
            None => {
                let extent = domain.periods.iter().flatten().copied().fold(0.0, f64::max);
                // Without an end the flow about a group reaches some ten times as far as the group.
                let reach = if extent > 0.0 { extent } else { 10.0 * length };
                (reach, reach / 12.0)
            }
        };
        let total: f64 = self.tethers.iter().map(|tether| tether.stiffness).sum();
        total / length.max(0.5 * reach) * mobility
    }
}
