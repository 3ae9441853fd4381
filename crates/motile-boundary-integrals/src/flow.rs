//! Hydrodynamics of a scene of interfaces by boundary integrals.

use std::f64::consts::TAU;

use motile_base::{
    Drive, FlowSample, ImposedFlow, Region, SolveReport, Vec2,
    internal::{all_points_finite, decimals, told_apart},
    positive,
};
use motile_scene::{
    Domain, FlowError, FlowWork, FluidView, Hydrodynamics, MarkerGroup, MarkerKind, Markers, ObstacleLoad, WallOutline,
    Warning, checkpoint::SavedState, gap::Boundary,
};
use stokes_boundary_integrals::{InterfaceFlow, LayerError, Settings};

use crate::{
    RigidWall,
    error::of_layers,
    interface_groups::InterfaceGroups,
    point_forces::PointForces,
    wall::{SharpCorner, narrowest},
};

/// Angle by which a wall may turn within the distance of two nodes (radians): the angle of a right corner which is
/// rounded over this distance. A sharp corner puts speeds next to it off by 1 % at nodes 0.1 radii apart.
const SHARPEST_TURN: f64 = 0.7;

/// Film next to a droplet that is squeezed through a narrow place, over its radius. It is the middle of 0.022, 0.014
/// and 0.010, measured in throats of 0.8, 1 and 1.4 radii at activity -3.5 up to t = 130.
const FILM_OF_SQUEEZED: f64 = 0.016;
/// Distances of nodes in the thinnest film that is resolved.
const RESOLVED_NODES: f64 = 0.3;

/// Computes Stokes flow of closed interfaces and rigid bodies in the plane, a periodic box or a channel, without a
/// grid. It is [`InterfaceFlow`], which has the equations, for the markers of bodies.
///
/// Every interface is a group of markers, [`MarkerKind::Interface`], [`MarkerKind::UnevenInterface`] or
/// [`MarkerKind::Rigid`]: `nodes` or more markers, counter-clockwise, marker k at the parameter 2 pi k/markers.
/// Positions and forces are truncated to the modes that the nodes carry, and velocities have these modes alone. Points
/// without forces ([`MarkerKind::Points`]) move with the flow. In the plane, points with forces can be regularised
/// Stokeslets ([`BoundaryIntegral::with_point_radius`]).
#[derive(Debug, Clone)]
#[doc(alias("boundary element method", "BEM", "Stokeslet"))]
pub struct BoundaryIntegral {
    interfaces: InterfaceGroups,
    work: FlowWork,
    walls: Boundary,
    /// Distance of the nodes of the walls at each side of their boundary (length).
    wall_spacings: Vec<f64>,
    /// Corners of the walls that their nodes do not resolve.
    sharp_corners: Vec<SharpCorner>,
    /// Minimum distance of the sides of a channel of rigid walls (length).
    narrowest: f64,
    outlines: Vec<WallOutline>,
    points: Option<PointForces>,
    /// Places and forces of the points that have forces.
    pushed: [Vec<Vec2>; 2],
}

impl BoundaryIntegral {
    /// Creates a solver for exterior fluid of the given viscosity (stress times time).
    ///
    /// # Errors
    /// Returns an error for a viscosity that is not positive and finite, or a region or settings out of their range.
    pub fn new(region: Region, viscosity: f64, settings: Settings) -> Result<Self, LayerError> {
        let interfaces = InterfaceGroups::new(InterfaceFlow::new(region, viscosity, settings)?);
        Ok(Self {
            interfaces,
            work: FlowWork::default(),
            walls: Boundary::default(),
            wall_spacings: Vec::new(),
            sharp_corners: Vec::new(),
            narrowest: f64::INFINITY,
            outlines: Vec::new(),
            points: None,
            pushed: Default::default(),
        })
    }

    /// Sets the perimeter (length) of the smallest interface, which [`Hydrodynamics::fluid_view`] assumes before
    /// the first evaluation; 2 pi by default.
    ///
    /// # Errors
    /// Returns an error for a perimeter that is not positive and finite.
    pub fn with_reference_perimeter(mut self, perimeter: f64) -> Result<Self, LayerError> {
        positive("the reference perimeter", perimeter)?;
        self.interfaces.set_reference_perimeter(perimeter);
        Ok(self)
    }

    /// Lets points have forces on them, in the plane and in fluid of one viscosity: each force is spread over a blob of
    /// that radius (length), of about the distance of neighbouring points. The forces in a scene have to add up to
    /// zero. The work of the points grows with the number of all markers times the number of points.
    ///
    /// # Errors
    /// Returns an error for another region than the plane, and a radius that is not positive and finite.
    pub fn with_point_radius(mut self, radius: f64) -> Result<Self, FlowError> {
        if *self.region() != Region::Plane {
            return Err(FlowError::unsupported(
                "force on points in a region that ends or repeats, by boundary integrals",
                "Use layers or the immersed boundary method, or the plane",
            ));
        }
        let radius = positive("the radius of points", radius)?;
        self.points = Some(PointForces { radius, viscosity: self.interfaces.flow.viscosity() });
        Ok(self)
    }

    /// Adds rigid walls and obstacles at rest ([`InterfaceFlow::with_walls`]) to a channel wider than they are. Time
    /// and memory grow with the third and second power of the number of their nodes.
    ///
    /// # Errors
    /// Returns an error for another region than a channel; more than 3000 nodes in all; walls beyond the errors of the
    /// channel; walls that cross or touch.
    pub fn with_walls(mut self, walls: &[RigidWall]) -> Result<Self, LayerError> {
        self.interfaces.flow = self.interfaces.flow.with_walls(walls.iter().map(RigidWall::curve))?;
        let mut boundary = Boundary::default();
        let mut wall_spacings = Vec::new();
        for wall in walls {
            let before = boundary.sides().len();
            wall.add_to(&mut boundary);
            wall_spacings.extend(wall.spacings(&boundary.sides()[before..]));
        }
        boundary.sort();
        let sharp_corners = walls.iter().enumerate().map(|(number, wall)| wall.sharp_corner(number, SHARPEST_TURN));
        let sharp_corners = sharp_corners.filter_map(Result::transpose).collect::<Result<_, _>>()?;
        let outlines = walls.iter().map(RigidWall::outline).collect();
        Ok(Self { walls: boundary, wall_spacings, sharp_corners, narrowest: narrowest(walls), outlines, ..self })
    }

    /// Returns the forces of the rigid walls on the fluid (force), wall by wall, from the last evaluation.
    pub fn wall_forces(&self) -> impl Iterator<Item = Vec2> {
        self.interfaces.flow.wall_forces()
    }

    /// Returns the region of the flow.
    #[must_use]
    pub fn region(&self) -> &Region {
        self.interfaces.flow.region()
    }

    /// Returns the resolution and accuracy.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        self.interfaces.flow.settings()
    }

    /// Returns the warnings of walls with corners that their nodes do not resolve.
    fn sharp_corners(&self) -> impl Iterator<Item = Warning> {
        self.sharp_corners.iter().map(|&SharpCorner { wall, turn, spacing, rounding }| {
            let [text, limit] = told_apart([turn, SHARPEST_TURN]);
            let spacing = decimals(3, spacing);
            let remedy = match rounding {
                Some(length) => format!(
                    "give this wall (not its outline) a rounding of {} or more, or closer nodes",
                    rounded_up(length)
                ),
                None => "give this wall closer nodes".to_owned(),
            };
            let message = format!(
                "a corner turns by {text} (radians) between two nodes, which are {spacing} apart, above {limit}: \
                 speeds beside such a corner are off by about a per cent at nodes 0.1 radii apart; {remedy}"
            );
            let (body, cause) = (format!("walls[{wall}]"), "corners not resolved".into());
            Warning { body, cause, excess: turn / SHARPEST_TURN, message }
        })
    }

    /// Returns the sides of a channel so close to one another that the smallest interface leaves a film there that its
    /// nodes do not resolve.
    fn narrow_place(&self) -> Option<Warning> {
        let (nodes, perimeter) = (self.settings().nodes as f64, self.interfaces.reference_perimeter());
        let (radius, narrowest) = (perimeter / TAU, self.narrowest);
        let needed = (RESOLVED_NODES * perimeter / (FILM_OF_SQUEEZED * radius)).ceil();
        if narrowest >= 2.0 * radius || nodes >= needed {
            return None;
        }
        let message = format!(
            "they leave {} (length) for an interface of radius {}: a droplet that is squeezed \
             through leaves gaps of about {}, which {nodes} nodes do not resolve, so that it may cross the wall; \
             use {needed} nodes",
            decimals(3, narrowest),
            decimals(3, radius),
            decimals(3, FILM_OF_SQUEEZED * radius)
        );
        let (body, cause) = ("rigid walls".to_owned(), "narrow place not resolved".into());
        Some(Warning { body, cause, excess: needed / nodes, message })
    }

    /// Takes over the points that have forces, and returns how they move the fluid; `None` if there are none.
    ///
    /// # Errors
    /// Returns an error for forces on points where they are not computed.
    fn load_points(&mut self, markers: &Markers) -> Result<Option<PointForces>, FlowError> {
        self.pushed.iter_mut().for_each(Vec::clear);
        for group in markers.groups().iter().filter(|group| group.kind == MarkerKind::Points) {
            let range = group.range.clone();
            let pairs = markers.positions()[range.clone()].iter().zip(&markers.forces()[range]);
            for (place, force) in pairs.filter(|(_, force)| **force != Vec2::ZERO) {
                self.pushed[0].push(*place);
                self.pushed[1].push(*force);
            }
        }
        if self.pushed[0].is_empty() {
            return Ok(None);
        }
        let Some(points) = self.points else {
            return Err(FlowError::unsupported(
                "force on points that do not belong to an interface",
                "Use layers or the immersed boundary method for scenes with solids or gels",
            ));
        };
        let same = |group: &MarkerGroup| {
            let viscosities = group.viscosities(points.viscosity);
            group.kind != MarkerKind::Rigid && viscosities.iter().all(|value| *value == points.viscosity)
        };
        if !markers.groups().iter().all(same) {
            return Err(FlowError::unsupported(
                "force on points next to rigid bodies or fluid of another viscosity, by boundary integrals",
                "Use one viscosity without rigid bodies, or layers in a box",
            ));
        }
        all_points_finite("the positions of points with forces", &self.pushed[0])?;
        all_points_finite("the forces on points", &self.pushed[1])?;
        Ok(Some(points))
    }
}

/// Returns the text of a positive number with two digits, none of which makes it smaller.
fn rounded_up(value: f64) -> String {
    let unit = 10.0_f64.powf(value.log10().floor() - 1.0);
    decimals(2, (value / unit).ceil() * unit)
}

impl Hydrodynamics for BoundaryIntegral {
    /// Returns a wave of wave number q on an interface relaxes at the rate `gamma q/(2 (eta_in + eta_ext))`. The
    /// stiffness is `q/4` (1/length) with the largest q that the nodes carry on the shortest interface of the last
    /// evaluation; before the first one with the reference perimeter.
    fn fluid_view(&self) -> FluidView {
        FluidView {
            domain: Domain { periods: self.interfaces.flow.periods(), ..Domain::from(*self.region()) },
            viscosity: self.interfaces.flow.viscosity(),
            spacing: None,
            second_order: true,
            shape_modes: Some(self.settings().nodes),
            nodes: Some(self.settings().nodes),
            interface_stiffness: self.interfaces.stiffness(),
        }
    }

    fn drive(&self) -> Option<Drive> {
        self.region().drive()
    }

    fn impose(&mut self, flow: ImposedFlow, strain: f64) -> Result<(), FlowError> {
        self.interfaces.flow.impose(flow, strain).map_err(of_layers)
    }

    fn imposed(&self) -> ImposedFlow {
        self.interfaces.flow.imposed()
    }

    fn strain(&self) -> f64 {
        self.interfaces.flow.strain()
    }

    fn walls(&self) -> Option<&Boundary> {
        if self.walls.is_empty() { None } else { Some(&self.walls) }
    }

    fn wall_spacings(&self) -> &[f64] {
        &self.wall_spacings
    }

    fn wall_slip(&self) -> Option<[f64; 2]> {
        let straight = self.interfaces.flow.obstacle_loads().all(|load| load.is_some());
        (self.drive().is_some() && straight).then(|| self.region().slip())
    }

    fn obstacle_loads(&self) -> Vec<Option<ObstacleLoad>> {
        let load = |load: stokes_boundary_integrals::ObstacleLoad| {
            let stokes_boundary_integrals::ObstacleLoad { centroid, force, torque, shear } = load;
            ObstacleLoad { centroid, force, torque, shear }
        };
        self.interfaces.flow.obstacle_loads().map(|found| found.map(load)).collect()
    }

    fn wall_outlines(&self) -> Vec<WallOutline> {
        self.outlines.clone()
    }

    fn warnings(&self) -> Vec<Warning> {
        self.sharp_corners().chain(self.narrow_place()).collect()
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        let points = self.load_points(markers)?;
        let report = self.interfaces.velocities(markers, &mut self.work)?;
        if let Some(points) = points {
            let [places, forces] = &self.pushed;
            let (_, positions, velocities) = markers.groups_and_lists();
            points.add_velocities(places, forces, positions, velocities);
        }
        Ok(report)
    }

    fn sample(&mut self, markers: &Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        let forced = self.load_points(markers)?;
        self.interfaces.sample(markers, points, out)?;
        if let Some(forced) = forced {
            forced.add_samples(&self.pushed[0], &self.pushed[1], points, out);
        }
        Ok(())
    }

    fn work(&self) -> FlowWork {
        self.work
    }

    fn save(&self) -> SavedState {
        let (mut saved, strain) = (self.interfaces.save(), self.strain());
        if strain != 0.0 {
            saved.reals.push(strain);
            saved.counts.push(1);
        }
        saved
    }

    fn load(&mut self, saved: &SavedState) {
        let (reals, counts, strain) = match (saved.reals.as_slice(), saved.counts.as_slice()) {
            ([reals @ .., strain], [counts @ .., 1]) if !counts.is_empty() => (reals, counts, *strain),
            (reals, counts) => (reals, counts, 0.0),
        };
        self.interfaces.restore(reals, counts);
        // A strain that is no number stays away.
        let _ = self.interfaces.flow.impose(self.imposed(), strain);
    }
}
