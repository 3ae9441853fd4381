//! Elastic walls: stiff, narrow, badly meshed.

use motile::base::Region;
use motile::base::{Drive, Vec2};
use motile::elastic_solids::ChannelShape;
use motile::elastic_solids::mesh::TriangleMesh;
use motile::elastic_solids::{Mesher, Moduli, Solid, Springs};
use motile::ib_core::{BSpline, ImmersedBoundary};
use motile::scene::Scene;
use motile::setup::{
    AnyFlow, DropletSetup, GridMethod, LayersMethod, Material, Method, Setup, SolidSetup, SurfaceElasticitySetup,
};
use motile::stokes_grid::{ChannelStokes, Grid};

use crate::hard_cases::drive::{by, held, run_way};
use crate::hard_cases::{CaseError, Ending, Extent, Look, Outcome, Recipe, Trial, Way, expand};

/// Walls that give way around a throat far narrower than the droplet fold at its corners: where a triangle is
/// inverted, adaptive steps shorten before the run ends.
const SQUEEZED: &[Ending] = &[Ending::Finished, Ending::Inverted, Ending::Stagnated];
/// Those of a material that is never inverted crease until they touch themselves.
const CREASED: &[Ending] = &[Ending::Finished, Ending::SelfContact, Ending::Stagnated];

/// A scene on a grid of spacing h between walls of Cowley's spring constant k, 1.5 thick, along a channel of width
/// 2.
fn between_walls(k: f64, shape: &ChannelShape, h: f64, length: f64) -> Result<Setup, CaseError> {
    let shear = Moduli::from_thesis_spring_constant(k)?.shear();
    Ok(Setup {
        region: Region::Channel { length, width: 5.0, drive: Drive::ZeroGradient },
        method: Method::Layers(LayersMethod::of_spacing(h)),
        solids: SolidSetup::walls(shape, &Material::Springs { shear }),
        ..Setup::default()
    })
}

/// A strong swimmer before a throat of a quarter of its radius, between soft walls.
fn throat() -> Result<Setup, CaseError> {
    let shape = ChannelShape::Constriction {
        width: 2.0,
        throat: 0.25,
        throat_length: 1.0,
        ramp: 1.0,
        exit_ramp: None,
        centre: 0.0,
    };
    let mut setup = between_walls(1e4, &shape, 0.125, 8.0)?;
    setup.droplets = vec![DropletSetup { centre: [-2.2, 0.0], ..DropletSetup::active(-5.0) }];
    Ok(setup)
}

/// The throat of a material whose energy grows without a bound as a triangle is flattened, and no contact.
fn held_throat(surface_elasticity: Option<SurfaceElasticitySetup>) -> Result<Setup, CaseError> {
    let mut setup = Setup { repulsion: Some(held(0.2)), ..throat()? };
    let shear = Moduli::from_thesis_spring_constant(1e4)?.shear();
    for wall in &mut setup.solids {
        (wall.material, wall.surface_elasticity) =
            (Material::NeoHookean { shear, bulk: 2.0 * shear }, surface_elasticity);
    }
    Ok(setup)
}

/// A swimmer of activity -2 in a channel as wide as it, between walls of Cowley's spring constant k.
fn stiff(
    k: f64,
    viscosity: f64,
    [quick, long]: [f64; 2],
    way: Way,
    extent: Extent,
    look: Look<'_>,
) -> Result<Outcome, CaseError> {
    let setup = Setup { viscosity, ..between_walls(k, &ChannelShape::Straight { width: 2.0 }, 0.1, 6.0)? };
    run_way(way, by(way, &setup).build()?.scene, extent.pick(quick, long), look)
}

/// A lower wall made from `mesh`, in shear flow.
fn sheared(mesh: TriangleMesh, way: Way, until: f64, look: Look<'_>) -> Result<Outcome, CaseError> {
    let mut solver = ChannelStokes::new(Grid::channel(60, 40, 0.1)?, 100.0)?;
    solver.set_drive(Drive::Gradient(-10.0))?;
    let flow: AnyFlow = Box::new(ImmersedBoundary::new(solver, BSpline::<4>));
    let mut scene = Scene::new(flow);
    let setup = Setup { method: Method::Grid(GridMethod::of_spacing(0.1)), ..Setup::default() };
    scene.add(setup.droplet(&DropletSetup { centre: [0.0, 0.3], ..DropletSetup::default() })?);
    let law = Springs::graded(&mesh, |_| 1000.0)?;
    scene.add(Solid::with_forces(mesh, law)?.named("wall").pinned(|s| s.y < -2.0 + 1e-9)?);
    run_way(way, scene, until, look)
}

/// The mesh of a wall of height one below the channel, whose inner points `place` may move; not those of its boundary.
fn disturbed(place: impl Fn(usize, Vec2) -> Vec2) -> Result<TriangleMesh, CaseError> {
    let channel = ChannelShape::Straight { width: 2.0 }.channel(6.0)?;
    let mesh = channel.walls(-2.0, 2.0, &Mesher::new(0.1)?)?.lower;
    let fixed: Vec<usize> = mesh.boundary_loops().iter().flat_map(|outline| outline.points.iter().copied()).collect();
    let points = mesh.points().iter().enumerate();
    let points = points.map(|(k, &p)| if fixed.contains(&k) { p } else { place(k, p) }).collect();
    Ok(TriangleMesh::periodic(points, mesh.triangles().to_vec(), 6.0)?)
}

/// Numbers between -1 and 1 without a pattern.
fn noise(k: usize) -> f64 {
    let bits = (k as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40;
    bits as f64 / f64::from(1 << 23) - 1.0
}

pub(crate) fn trials() -> Vec<Trial> {
    let both: &[Way] = &[Way::Grid, Way::Chebyshev];
    expand(&[
        Recipe::new(4, "walls k = 1e6, viscosity 100", both, |way, extent, look| {
            stiff(1e6, 100.0, [0.3, 10.0], way, extent, look)
        }),
        Recipe::new(4, "walls k = 1e6, viscosity 10", both, |way, extent, look| {
            stiff(1e6, 10.0, [0.03, 1.0], way, extent, look)
        }),
        Recipe::new(4, "walls k = 1e7, viscosity 100", both, |way, extent, look| {
            stiff(1e7, 100.0, [0.03, 1.0], way, extent, look)
        }),
        Recipe::new(4, "walls k = 1e7, viscosity 10", both, |way, extent, look| {
            stiff(1e7, 10.0, [0.003, 0.2], way, extent, look)
        }),
        Recipe::new(8, "a throat of R0/4", both, |way, extent, look| {
            let setup = throat()?;
            run_way(way, by(way, &setup).build()?.scene, extent.pick(1.0, 40.0), look)
        })
        .ending_in(SQUEEZED)
        .area_within(5e-3),
        Recipe::new(8, "a throat of R0/4, neo-Hookean, held apart", both, |way, extent, look| {
            run_way(way, by(way, &held_throat(None)?).build()?.scene, extent.pick(1.0, 40.0), look)
        })
        .ending_in(CREASED)
        .area_within(5e-3),
        Recipe::new(
            8,
            "a throat of R0/4, neo-Hookean with surface elasticity, held apart",
            both,
            |way, extent, look| {
                let setup = held_throat(Some(SurfaceElasticitySetup { stretching: 100.0, bending: 0.3 }))?;
                run_way(way, by(way, &setup).build()?.scene, extent.pick(1.0, 40.0), look)
            },
        )
        .area_within(5e-3),
        Recipe::new(15, "a highly irregular wall mesh", both, |way, extent, look| {
            let mesh = disturbed(|k, p| p + 0.025 * Vec2::new(noise(2 * k), noise(2 * k + 1)))?;
            sheared(mesh, way, extent.pick(1.0, 20.0), look)
        }),
        Recipe::new(15, "one sliver triangle", both, |way, extent, look| {
            // A point is moved almost onto the opposite edge of one of its triangles.
            let plain = disturbed(|_, p| p)?;
            let near = |k: &usize| (plain.points()[*k] - Vec2::new(0.0, -1.5)).length();
            let chosen = (0..plain.points().len()).min_by(|a, b| near(a).total_cmp(&near(b))).unwrap_or(0);
            let triangle = plain.triangles().iter().find(|corners| corners.contains(&chosen));
            let others: Vec<Vec2> = triangle
                .into_iter()
                .flatten()
                .filter(|&&corner| corner != chosen)
                .map(|&corner| plain.points()[corner])
                .collect();
            let middle = others.iter().sum::<Vec2>() / others.len().max(1) as f64;
            let mesh = disturbed(|k, p| if k == chosen { p.lerp(middle, 0.97) } else { p })?;
            sheared(mesh, way, extent.pick(1.0, 20.0), look)
        }),
    ])
}
