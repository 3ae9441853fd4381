//! Elastic solids and other rigid or elastic bodies of a scene: shapes and measurements.

use std::any::Any;

use motile::active_interface::{ActiveDroplet, ActiveInterface};
use motile::elastic_solids::{Deformation, Fibre, Mat2, Solid, width_between};
use motile::interior::{GelInDroplet, GelInLayer, ParticlesInDroplet};
use motile::scene::{
    Body, Handle, Hydrodynamics, System,
    gap::{Boundary, SolidGap},
};

use crate::{OutputError, SolidShape};
use motile::base::Vec2;

/// Solids of a system, in the order of addition.
pub(crate) fn solids<H: Hydrodynamics>(system: &System<H>) -> impl Iterator<Item = &Solid> {
    system.bodies().map(|(_, solid)| solid)
}

/// Returns the present shape of a solid; one period of a periodic wall.
pub(crate) fn solid_shape(solid: &Solid) -> SolidShape {
    let (mesh, displacements): (_, Vec<Vec2>) = (solid.mesh(), solid.displacements().collect());
    let mut shape = SolidShape::default();
    for (triangle, nodes) in mesh.triangles().iter().enumerate() {
        shape.triangles.extend(mesh.corners(triangle, solid.positions()));
        shape.displacement.push(nodes.iter().map(|&node| displacements[node]).sum::<Vec2>().length() / 3.0);
    }
    shape.stress = stress_deviators(solid);
    if let Some(stresses) = solid.internal_stresses().ok().flatten() {
        shape.internal_stress = stresses.iter().map(deviator).collect();
    }
    shape.bonds = bonds(solid);
    // Lines around the period run to the right or to the left, with the solid on their left: the area is between one
    // period of both.
    let mut end: Option<Vec2> = None;
    let mut around: Vec<Vec2> = Vec::new();
    for boundary in mesh.boundary_loops() {
        let Some(mut line) = mesh.boundary_polygon(boundary, solid.positions()) else { continue };
        let period = f64::from(boundary.periods) * mesh.period().unwrap_or(0.0);
        line.push(line[0] + Vec2::new(period, 0.0));
        if boundary.periods == 0 {
            shape.area.push(line.clone());
        } else {
            if let Some(end) = end {
                let shift = period * ((end.x - line[0].x) / period).round();
                line.iter_mut().for_each(|point| point.x += shift);
            }
            end = line.last().copied();
            around.extend(&line);
        }
        shape.edges.push(line);
    }
    if !around.is_empty() {
        shape.area.push(around);
    }
    shape
}

/// Returns the bodies of a system that are curves but no fluid interfaces: rigid bodies, membranes.
pub(crate) fn curves<H: Hydrodynamics>(system: &System<H>) -> impl Iterator<Item = (Handle<dyn Body>, &dyn Body)> {
    system.all_bodies().filter(|(_, body)| {
        let any: &dyn Any = *body;
        body.kind().is_curve() && !any.is::<ActiveDroplet>() && !any.is::<ActiveInterface>()
    })
}

/// Returns the shapes of these bodies; rigid ones are filled.
pub(crate) fn curve_shapes<H: Hydrodynamics>(system: &System<H>) -> impl Iterator<Item = SolidShape> {
    let periods = system.hydrodynamics().fluid_view().domain.periods;
    curves(system).map(move |(_, body)| {
        let mut shape = rigid_shape(&Boundary::of(body, periods), None);
        if body.kind().holds_fluid() {
            shape.area.clear();
            shape.holds_fluid = true;
        }
        shape
    })
}

/// Returns the bodies of a system of types that this crate does not know, whose markers are points in no order.
pub(crate) fn others<H: Hydrodynamics>(system: &System<H>) -> impl Iterator<Item = (Handle<dyn Body>, &dyn Body)> {
    system.all_bodies().filter(|(_, body)| {
        let any: &dyn Any = *body;
        let known = any.is::<Solid>()
            || any.is::<Fibre>()
            || any.is::<GelInDroplet>()
            || any.is::<GelInLayer>()
            || any.is::<ParticlesInDroplet>();
        !known && !body.kind().is_curve() && body.marker_count() > 0
    })
}

/// Returns the shapes of these bodies: filled if they have a surface, otherwise a dot at each marker.
pub(crate) fn other_shapes<H: Hydrodynamics>(system: &System<H>) -> impl Iterator<Item = SolidShape> {
    let periods = system.hydrodynamics().fluid_view().domain.periods;
    others(system).map(move |(_, body)| {
        let mut shape = rigid_shape(&Boundary::of(body, periods), None);
        if shape.edges.is_empty() {
            let mut markers = vec![Vec2::ZERO; body.marker_count()];
            body.write_markers(&mut markers);
            shape.edges = markers.into_iter().map(|marker| vec![marker; 2]).collect();
        }
        shape
    })
}

/// Returns the line of a fibre: all of its nodes, closed or over one period where it has no ends (length).
pub(crate) fn fibre_line(fibre: &Fibre) -> Vec<Vec2> {
    let nodes = fibre.nodes();
    let end = fibre.period().zip(nodes.first()).map(|(period, first)| *first + period);
    nodes.iter().copied().chain(end).collect()
}

/// Returns the shapes of the fibres of a system: lines alone.
pub(crate) fn fibre_shapes<H: Hydrodynamics>(system: &System<H>) -> impl Iterator<Item = SolidShape> {
    let shape = |(_, fibre): (_, &Fibre)| SolidShape { edges: vec![fibre_line(fibre)], ..SolidShape::default() };
    system.bodies().map(shape)
}

/// Returns the shape of rigid walls and obstacles; open ones reach to the straight walls behind them.
pub(crate) fn rigid_shape(boundary: &Boundary, straight: Option<[f64; 2]>) -> SolidShape {
    let mut shape = SolidShape::default();
    let mut line: Vec<Vec2> = Vec::new();
    let mut finish = |line: &mut Vec<Vec2>| {
        let (Some(&first), Some(&last)) = (line.first(), line.last()) else { return };
        let mut area = line.clone();
        if let Some([below, above]) = straight.filter(|_| first.distance(last) > 1e-6 * (last - first).x.abs()) {
            // The rigid side is on the left.
            let behind = if last.x > first.x { above } else { below };
            area.extend([Vec2::new(last.x, behind), Vec2::new(first.x, behind), first]);
        }
        shape.area.push(area);
        shape.edges.push(std::mem::take(line));
    };
    for &[start, end] in boundary.sides() {
        // The next side may continue the line at its end or at its start.
        let same = 1e-9 * start.distance(end);
        let follows = |end: Vec2, start: Vec2| end.distance(start) <= same;
        match (line.first().copied(), line.last().copied()) {
            (_, Some(last)) if follows(last, start) => line.push(end),
            (Some(first), _) if follows(end, first) => line.insert(0, start),
            _ => {
                finish(&mut line);
                line.extend([start, end]);
            }
        }
    }
    finish(&mut line);
    shape
}

/// Returns the deviator of the Cauchy stress in each triangle (force per length); not a number if one is inverted.
pub(crate) fn stress_deviators(solid: &Solid) -> Vec<f64> {
    let Ok(stresses) = solid.stresses() else { return vec![f64::NAN; solid.mesh().triangles().len()] };
    stresses.iter().map(deviator).collect()
}

/// Returns the deviator of a symmetric stress.
pub(crate) fn deviator(stress: &Mat2) -> f64 {
    (0.5 * (stress.x_axis.x - stress.y_axis.y)).hypot(stress.x_axis.y)
}

/// Ends of the active springs of a solid that are on (length).
fn bonds(solid: &Solid) -> Vec<Vec<Vec2>> {
    let mesh = solid.mesh();
    let on = mesh.edges().iter().zip(solid.active_bonds().unwrap_or_default()).filter(|(_, on)| **on);
    on.map(|(edge, _)| {
        let [from, to] = edge.points.map(|point| solid.positions()[point]);
        vec![from, to + Vec2::new(f64::from(edge.periods) * mesh.period().unwrap_or(0.0), 0.0)]
    })
    .collect()
}

/// Measurement of the solids of a system, for rows of a table.
#[derive(Debug, Clone)]
pub struct SolidMeter {
    gap: SolidGap,
}

impl SolidMeter {
    /// Names of the measured quantities: smallest and largest width of the channel between the first two solids, gap
    /// between droplet and solids, largest displacements in any direction and normal to a surface, largest mean
    /// displacement of a solid along the channel (all lengths), elastic energy (force times length), smallest ratio of
    /// deformed to reference area of a triangle.
    pub const NAMES: [&'static str; 8] = [
        "channel_width_min",
        "channel_width_max",
        "droplet_gap",
        "largest_displacement",
        "largest_normal_displacement",
        "wall_drift",
        "elastic_energy",
        "smallest_jacobian",
    ];

    /// Creates a meter for a system with solids; `None` for one without.
    #[must_use]
    pub fn of<H: Hydrodynamics>(system: &System<H>) -> Option<Self> {
        solids(system).next().map(|_| Self { gap: SolidGap::new(f64::INFINITY) })
    }

    /// Returns the values of [`SolidMeter::NAMES`] in the present state; not a number for quantities that the system
    /// does not have.
    ///
    /// # Errors
    /// Returns [`OutputError::Solid`] for a solid whose energy is not defined, such as one with an inverted triangle.
    pub fn measure<H: Hydrodynamics>(&mut self, system: &System<H>) -> Result<[f64; 8], OutputError> {
        let mut pair = solids(system);
        let width = pair.next().zip(pair.next()).and_then(|(lower, upper)| width_between(lower, upper).ok());
        let gap = self.gap.measure(system).map_or(f64::NAN, |nearest| nearest.gap);
        let (mut total, mut normal, mut drift, mut energy, mut jacobian) =
            (0.0_f64, 0.0_f64, 0.0_f64, 0.0, f64::INFINITY);
        for solid in solids(system) {
            let seen = Deformation::of(solid);
            total = total.max(seen.largest_displacement);
            normal = normal.max(seen.largest_normal_displacement);
            drift = if seen.drift.x.abs() > drift.abs() { seen.drift.x } else { drift };
            energy += solid.elastic_energy()?;
            jacobian = jacobian.min(seen.smallest_jacobian);
        }
        let [narrowest, widest] = width.map_or([f64::NAN; 2], |width| [width.minimum, width.maximum]);
        Ok([narrowest, widest, gap, total, normal, drift, energy, jacobian])
    }
}

#[cfg(test)]
mod tests;
