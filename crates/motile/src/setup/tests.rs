use active_interface::{Curve, Motion, polygon_moments};
use motile_base::{Drive, Vec2};
use motile_scene::{Body, Handle, Scene, StepSize};

use motile_interior::{DirectorStart, GelInBox, GelMaterial};

use super::*;
use elastic_solids::{ChannelShape, Outline};

fn channel(width: f64) -> Region {
    Region::Channel { length: 6.0, width, drive: Drive::ZeroGradient }
}

fn elastic(width: f64, method: Method) -> Setup {
    let solids = SolidSetup::walls(&ChannelShape::Straight { width }, &Material::Springs { shear: 187.5 });
    Setup { region: channel(width + 2.0), method, solids, ..Setup::default() }
}

/// Solids' surfaces as layers, and on the grid.
fn layers() -> Method {
    Method::Layers(LayersMethod::of_spacing(0.1))
}

fn plain() -> Method {
    Method::Grid(GridMethod::uncorrected(0.1))
}

/// Key, value and remedy of what is wrong.
fn refused(setup: &Setup) -> String {
    match setup.build() {
        Err(error) => error.to_string(),
        Ok(built) => panic!("{setup:?}: {built:?}"),
    }
}

#[test]
fn numbers_that_govern_a_droplet() {
    let of = |droplet: DropletSetup| {
        let setup = Setup { viscosity: 50.0, ..Setup::default() };
        setup.numbers(&droplet).unwrap()
    };
    assert_eq!(of(DropletSetup::passive(10.0)), None);
    assert_eq!(of(DropletSetup::active(0.0)), None);
    let round = DropletSetup { viscosity: Some(150.0), ..DropletSetup::contractile(-4.0, 8.0).with_radius(2.0) };
    let numbers = of(round.clone()).unwrap();
    let wanted = Numbers { peclet: 40.0, excluded_volume: Some(2.0), bare_tension: 0.025, viscosity_ratio: 3.0 };
    assert_eq!(numbers, wanted);
    // The radius is that of the circle of the same area, however the shape is given.
    let circle: Vec<[f64; 2]> =
        (0..40).map(|k| std::f64::consts::TAU * f64::from(k) / 40.0).map(|t| [2.0 * t.cos(), 2.0 * t.sin()]).collect();
    for shape in [
        DropletShape::Ellipse { half_axes: [4.0, 1.0] },
        DropletShape::Modes { radius: 2.0 / 1.02_f64.sqrt(), cosines: vec![0.0, 0.2], sines: vec![] },
        DropletShape::Points(circle),
    ] {
        let found = of(DropletSetup { shape, ..round.clone() }).unwrap();
        assert!((found.peclet / 40.0 - 1.0).abs() < 1e-4, "{found:?}");
    }
}

#[test]
fn what_makes_no_scene_is_refused_with_its_key() {
    let one = |droplet: DropletSetup| Setup { droplets: vec![droplet], ..Setup::default() };
    let with = |particles: Particles| one(DropletSetup { particles: Some(particles), ..DropletSetup::default() });
    let grid = |grid: GridMethod| Setup { method: Method::Grid(grid), ..Setup::default() };
    let coarse = GridMethod::of_spacing(0.1);
    for bad in [f64::NAN, f64::INFINITY, -1.0] {
        let cases = [
            ("viscosity =", Setup { viscosity: bad, ..Setup::default() }),
            ("tolerance =", Setup { tolerance: Some(bad), ..Setup::default() }),
            ("region.box.lengths[1] =", Setup { region: Region::Box { lengths: [6.0, bad] }, ..Setup::default() }),
            ("region.channel.width =", Setup { region: channel(bad), ..Setup::default() }),
            ("step.fixed =", Setup { step: StepSize::Fixed(bad), ..Setup::default() }),
            ("step.of-limit =", Setup { step: StepSize::OfLimit(bad), ..Setup::default() }),
            ("step.adaptive.tolerance =", Setup { step: StepSize::Adaptive { tolerance: bad }, ..Setup::default() }),
            ("method.grid.spacing =", grid(GridMethod::of_spacing(bad))),
            ("method.grid.marker-spacing =", grid(GridMethod { marker_spacing: Some(bad), ..coarse })),
            ("droplets[0].viscosity =", one(DropletSetup { viscosity: Some(bad), ..DropletSetup::default() })),
            ("droplets[0].tension =", one(DropletSetup { tension: bad, ..DropletSetup::default() })),
            ("droplets[0].centre[1] =", one(DropletSetup { centre: [0.0, f64::NAN], ..DropletSetup::default() })),
            ("droplets[0].shape.round.radius =", {
                one(DropletSetup { shape: DropletShape::Round { radius: bad }, ..DropletSetup::default() })
            }),
            ("droplets[0].particles.diffusion =", with(Particles { diffusion: bad, ..Particles::default() })),
            ("droplets[0].particles.concentration =", with(Particles { concentration: bad, ..Particles::default() })),
            ("droplets[0].particles.excluded-volume.step =", {
                with(Particles { excluded_volume: ExcludedVolume::Step(bad), ..Particles::default() })
            }),
        ];
        for (key, setup) in cases {
            assert!(refused(&setup).starts_with(key), "{key}: {}", refused(&setup));
        }
    }
    let nodes =
        |nodes, elements| Setup { method: Method::Integral(IntegralMethod { nodes, elements }), ..Setup::default() };
    let contrast = DropletSetup { viscosity: Some(10.0), ..DropletSetup::default() };
    let cases = [
        ("method.integral.nodes = 4", nodes(4, 64)),
        ("method.integral.elements = 32", nodes(64, 32)),
        ("method.integral.elements", nodes(64, usize::MAX)),
        ("method.grid.spacing = 0.07: a length of 6 is not a whole number", grid(GridMethod::of_spacing(0.07))),
        ("method.grid.spacing = 0.0000001: a length of 6 would need", grid(GridMethod::of_spacing(1e-7))),
        ("method.grid.spacing = 0.1: a length of 1000 would need 10000 cells, 1.0e8 in all", {
            Setup { region: Region::Box { lengths: [1e3; 2] }, ..grid(coarse) }
        }),
        ("droplets[0].particles.start.perturbed.amplitude = 1: use a number from 0 to below 1", {
            with(Particles { start: Start::Perturbed { amplitude: 1.0, seed: 1 }, ..Particles::default() })
        }),
        ("method.grid.marker-spacing = 0.0000000001", grid(GridMethod { marker_spacing: Some(1e-10), ..coarse })),
        ("region = plane", Setup { region: Region::Plane, ..grid(coarse) }),
        ("method = integral: it does not support solids. Use layers or grid", elastic(3.0, Method::default())),
        ("method = grid: it does not support rigid bodies. Use integral or layers", {
            Setup { rigid_bodies: vec![RigidBodySetup::default()], ..grid(coarse) }
        }),
        ("method = grid: it does not support imposed flows. Use integral", {
            Setup { flow: FlowSetup { shear: 0.1, ..FlowSetup::default() }, ..grid(coarse) }
        }),
        ("method = grid: it does not support rigid walls that stand in a channel. Use integral", {
            let walls = WallSetup::channel(&ChannelShape::Straight { width: 3.0 }, 0.15);
            Setup { region: channel(6.0), walls, ..grid(coarse) }
        }),
        ("method = layers: it does not support rigid walls", {
            let walls = WallSetup::channel(&ChannelShape::Straight { width: 3.0 }, 0.15);
            Setup { region: channel(6.0), method: layers(), walls, ..Setup::default() }
        }),
        ("method.grid.corrected = true: the mobility correction cannot handle solids", {
            Setup { method: Method::Grid(coarse), ..elastic(3.0, plain()) }
        }),
        ("method.grid.corrected = true", Setup { droplets: vec![DropletSetup::thesis()], ..grid(coarse) }),
        ("method.grid.corrected = true", { Setup { droplets: vec![contrast], ..grid(coarse) } }),
        ("least-gap", Setup { least_gap: Some(f64::NAN), ..Setup::default() }),
        ("droplets[0]: the body does not fit into the region of 1.9 x 6. Move it", {
            Setup { region: Region::Box { lengths: [1.9, 6.0] }, ..Setup::default() }
        }),
        ("droplets[0]: the body does not fit into the region of 6 x 3. Move it", {
            let off = DropletSetup { centre: [0.0, 1.45], ..DropletSetup::default() };
            Setup { region: channel(3.0), droplets: vec![off], ..Setup::default() }
        }),
    ];
    for (start, setup) in cases {
        assert!(refused(&setup).starts_with(start), "{start}: {}", refused(&setup));
    }
    let large = Setup { droplets: vec![DropletSetup::active(-15.0).with_radius(10.0)], ..Setup::default() };
    let defaults = "a radius of 10 and the defaults viscosity 100 (10), concentration 100 (10), diffusion 0.1 (10) are \
                    of different units";
    assert!(refused(&large).contains(defaults), "{}", refused(&large));
    // One droplet with equally spaced markers is enough for a correction.
    let thesis = DropletSetup { centre: [-1.5, 0.0], ..DropletSetup::thesis() };
    let default = DropletSetup { centre: [1.5, 0.0], ..DropletSetup::default() };
    assert!(Setup { droplets: vec![thesis, default], ..grid(coarse) }.check().is_ok());
}

#[test]
fn exchanges_that_make_no_scene_are_refused() {
    let with = |exchange: ExchangeSetup| DropletSetup {
        particles: Some(Particles { exchange: Some(exchange), ..Particles::default() }),
        ..DropletSetup::default()
    };
    let of = |droplet: DropletSetup| Setup { droplets: vec![droplet], ..Setup::default() };
    let diffusing = ExchangeSetup { diffusion_inside: Some(0.5), ..ExchangeSetup::new(0.1, 0.1) };
    let cases = [
        ("particles.exchange.binding =", with(ExchangeSetup::new(-1.0, 0.1))),
        ("particles.exchange.binding =", with(ExchangeSetup::new(0.0, 0.1))),
        ("particles.exchange.diffusion-inside =", with(ExchangeSetup { diffusion_inside: Some(0.0), ..diffusing })),
        ("particles.exchange.spacing-inside =", with(ExchangeSetup { spacing_inside: Some(f64::NAN), ..diffusing })),
        ("motion =", DropletSetup { motion: Motion::WithFluid, ..with(diffusing) }),
    ];
    for (key, droplet) in cases {
        let error = of(droplet).check().unwrap_err().to_string();
        assert!(error.contains(key), "{error}");
    }
    let coarse = refused(&of(with(ExchangeSetup { spacing_inside: Some(0.7), ..diffusing })));
    assert!(
        coarse.starts_with("droplet.particles.exchange.spacing-inside = 0.7: this spacing is too wide for"),
        "{coarse}"
    );
    of(with(diffusing)).build().unwrap();
}

#[test]
fn gels_that_make_no_scene_are_refused() {
    let with = |gel: GelSetup| Setup {
        method: Method::Grid(GridMethod::of_spacing(0.1)),
        droplets: vec![DropletSetup { gel: Some(gel), ..DropletSetup::default() }],
        ..Setup::default()
    };
    let of = |material: GelMaterial| with(GelSetup { material, ..GelSetup::default() });
    let usual = GelMaterial::default();
    let cases = [
        ("droplets[0].gel.material.frank =", of(GelMaterial { frank: -1.0, ..usual })),
        ("droplets[0].gel.material.rotational-viscosity =", of(GelMaterial { rotational_viscosity: 0.0, ..usual })),
        ("droplets[0].gel.material.alignment =", of(GelMaterial { alignment: f64::NAN, ..usual })),
        ("droplets[0].gel.material.activity =", of(GelMaterial { activity: f64::INFINITY, ..usual })),
        ("droplets[0].gel.spacing =", with(GelSetup { spacing: Some(0.0), ..GelSetup::default() })),
        ("droplet.gel.spacing = 0.6: this spacing is too wide for a droplet of radius 1.000. Use 0.500 or less", {
            with(GelSetup { spacing: Some(0.6), ..GelSetup::default() })
        }),
        (
            "droplets[0]: the mesh is too fine: it would have some 3",
            with(GelSetup { spacing: Some(1e-6), ..GelSetup::default() }),
        ),
        ("droplets[0].gel.start.uniform.noise =", {
            let start = DirectorStart::Uniform { angle: 0.0, noise: -1.0, seed: 0 };
            with(GelSetup { start, ..GelSetup::default() })
        }),
        ("method = integral: it does not support gels. Use layers or grid", {
            Setup { method: Method::default(), ..with(GelSetup::default()) }
        }),
        ("droplets[0].motion =", {
            let mut setup = with(GelSetup::default());
            setup.droplets[0].motion = Motion::WithFluid;
            let spacing = GridMethod::of_spacing(0.1);
            setup.method = Method::Grid(GridMethod { corrected: false, ..spacing });
            setup
        }),
        ("droplets[0].gel = a gel: solids[0] lies inside", {
            Setup { method: plain(), solids: vec![disc(0.1, 0.0, 0.3)], ..with(GelSetup::default()) }
        }),
    ];
    for (start, setup) in cases {
        assert!(refused(&setup).starts_with(start), "{start}: {}", refused(&setup));
    }
    assert!(of(usual).build().is_ok());
}

#[test]
fn gels_fill_boxes_and_nothing_else_lies_in_them() {
    let start = DirectorStart::Random { seed: 3 };
    let gel = GelInBoxSetup { start, ..GelInBoxSetup::default() };
    let base = Setup {
        region: Region::Box { lengths: [3.0, 2.0] },
        method: Method::Grid(GridMethod::of_spacing(0.1)),
        droplets: Vec::new(),
        gels: vec![gel],
        ..Setup::default()
    };
    let of = |gel: GelInBoxSetup| Setup { gels: vec![gel], ..base.clone() };
    let cases = [
        (
            "gels[0].material.frank = -1",
            of(GelInBoxSetup { material: GelMaterial { frank: -1.0, ..gel.material }, ..gel }),
        ),
        ("gels[0].spacing = 0", of(GelInBoxSetup { spacing: Some(0.0), ..gel })),
        (
            "gels[0]: the mesh is too fine: it would have some 6.0e14 nodes",
            of(GelInBoxSetup { spacing: Some(1e-7), ..gel }),
        ),
        ("gels[0].start = around a centre", of(GelInBoxSetup { start: DirectorStart::Aster, ..gel })),
        (
            "method = layers: it does not support gels that fill a box. Use grid",
            Setup { method: layers(), ..base.clone() },
        ),
        ("region = channel", Setup { region: channel(3.0), ..base.clone() }),
        ("gels = 2: ", Setup { gels: vec![gel; 2], ..base.clone() }),
        ("gels = 1: ", Setup { droplets: vec![DropletSetup::default()], ..base.clone() }),
    ];
    for (start, setup) in cases {
        assert!(refused(&setup).starts_with(start), "{start}: {}", refused(&setup));
    }
    // The scene is the one put together by hand, also on nodes that are not the grid's.
    for (spacing, counts) in [(None, [30, 20]), (Some(0.11), [28, 19])] {
        let Built { mut scene, gels, .. } = of(GelInBoxSetup { spacing, ..gel }).build().unwrap();
        let mut by_hand = Scene::new(base.flow().unwrap()).with_step_size(base.step);
        let body = GelInBox::new(gel.material, [3.0, 2.0], counts, start.angles(Vec2::ZERO).unwrap()).unwrap();
        let other = by_hand.add(body);
        assert_eq!(scene.body(gels[0]).unwrap().nodes(), by_hand.body(other).unwrap().nodes());
        scene.run(0.2).go().unwrap();
        by_hand.run(0.2).go().unwrap();
        assert!(scene.system().steps() > 0 && scene.system().steps() == by_hand.system().steps());
        assert_eq!(scene.body(gels[0]).unwrap().angles(), by_hand.body(other).unwrap().angles());
    }
}

#[test]
fn layers_that_make_no_scene_are_refused() {
    let method = LayersMethod::of_spacing(0.1);
    let base = elastic(3.0, layers());
    let of = |layers: LayersMethod| Setup { method: Method::Layers(layers), ..base.clone() };
    let solid = |solid: SolidSetup| Setup { solids: vec![solid], ..base.clone() };
    let wall = base.solids[0].clone();
    let cases = [
        ("method.layers.nodes = 4", of(LayersMethod { nodes: 4, elements: 64, ..method })),
        ("method.layers.elements = 32", of(LayersMethod { nodes: 64, elements: 32, ..method })),
        ("method.layers.spacing = 0.07: a length of 6 is not", of(LayersMethod::of_spacing(0.07))),
        ("method.layers.spacing = -1", of(LayersMethod::of_spacing(-1.0))),
        ("method.layers.kernel = Peskin4", of(LayersMethod { kernel: ib_core::AnyKernel::Peskin4, ..method })),
        ("region = plane", Setup { region: Region::Plane, method: layers(), ..Setup::default() }),
        ("solids[0].mesh-spacing = 0.1", solid(SolidSetup { mesh_spacing: Some(0.1), ..wall.clone() })),
    ];
    for (start, setup) in cases {
        assert!(refused(&setup).starts_with(start), "{start}: {}", refused(&setup));
    }
    // Points on a finer surface are as far apart as the grid's, those below it twice as far; with forces on triangles
    // half as far on the surface, as the grid's.
    for (finer_surface, spread_over_triangles, times) in
        [(None, false, 1), (Some(true), false, 2), (None, true, 1), (Some(true), true, 4)]
    {
        let wall = SolidSetup { finer_surface, spread_over_triangles, ..wall.clone() };
        let setup = solid(wall);
        let spacing = setup.flow().unwrap().fluid_view().spacing;
        assert_eq!(spacing, Some(if spread_over_triangles { 0.05 } else { 0.1 }));
        let Built { mut scene, solids, .. } = setup.build().unwrap();
        scene.step(1e-3).unwrap();
        let mesh = scene.body(solids[0]).unwrap().mesh();
        let [lower, upper] = [0, 1].map(|k| mesh.boundary_loops()[k].points.len());
        assert!(lower.abs_diff(30) < 4 && upper == times * lower, "{lower} {upper}");
    }
}

/// Walls along points of one's own, from either end and with or without the end of the period, are those of the shape
/// that the points are of, to second order in their distance.
#[test]
fn walls_through_points() {
    let shape = ChannelShape::Sinusoidal { width: 3.0, amplitude: 0.2, waves: 1, phase: 0.0 };
    let channel = shape.channel(12.0).unwrap();
    let of = |line: &Outline, count: usize| -> Vec<[f64; 2]> {
        line.resampled(line.length() / count as f64).unwrap().into_iter().map(Vec2::to_array).collect()
    };
    let region = Region::Channel { length: 12.0, width: 5.0, drive: Drive::ZeroGradient };
    let walls = |outlines: [SolidOutline; 2]| {
        let walls = outlines.map(|outline| WallSetup::new(outline, 0.2)).to_vec();
        let method = Method::Integral(IntegralMethod::default());
        Setup { region, method, walls, ..Setup::default() }
    };
    let exact = walls([SolidOutline::WallBelow(shape), SolidOutline::WallAbove(shape)]).rigid_walls().unwrap();
    let error = |count: usize| {
        let [mut below, above] = [channel.lower(), channel.upper()].map(|line| of(line, count));
        below.push([below[0][0] + 12.0, below[0][1]]);
        below.reverse();
        let setup = walls([SolidOutline::WallBelowPoints(below), SolidOutline::WallAbovePoints(above)]);
        setup.build().unwrap();
        let walls = setup.rigid_walls().unwrap();
        let pairs = walls.iter().zip(&exact).flat_map(|(a, b)| a.points().iter().zip(b.points()));
        pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
    };
    let [coarse, fine] = [60, 120].map(error);
    assert!(fine < 1e-3 && (coarse / fine).log2() > 1.8, "{coarse:.1e} {fine:.1e}");

    // Elastic walls of a flat line are those of a straight channel.
    let straight = elastic(3.0, plain());
    let flat = |y: f64| [-3.0, -1.5, 0.0, 1.5].map(|x| [x, y]).to_vec();
    let mut own = straight.clone();
    own.solids[0].outline = SolidOutline::WallBelowPoints(flat(-1.5));
    own.solids[1].outline = SolidOutline::WallAbovePoints(flat(1.5));
    let meshes = |setup: &Setup| {
        let Built { scene, solids, .. } = setup.build().unwrap();
        let meshes = solids.iter().map(|&solid| scene.body(solid).unwrap().mesh());
        meshes.map(|mesh| (mesh.points().len(), mesh.area())).collect::<Vec<_>>()
    };
    for ((points, area), (others, expected)) in meshes(&own).into_iter().zip(meshes(&straight)) {
        assert!(points == others && (area - expected).abs() < 1e-9, "{points} {others} {area} {expected}");
    }
    own.solids[0].outline = SolidOutline::WallBelowPoints(flat(-2.5));
    let said = own.check().unwrap_err().to_string();
    assert!(said.starts_with("solids[0].outline.wall-below-points[0][1] = -2.5: use heights between"), "{said}");
}

/// A layer needs sixteen points: a solid with fewer on its surface is refused by name and key before any work, and the
/// spacing that the error gives is enough.
#[test]
fn a_surface_of_too_few_points_is_refused() {
    let of = |grid: f64, finer_surface: Option<bool>| Setup {
        method: Method::Layers(LayersMethod::of_spacing(grid)),
        solids: vec![SolidSetup {
            name: "bead".to_owned(),
            outline: SolidOutline::Disc { centre: [0.0, 0.0], radius: 0.5 },
            hold: Hold::Free,
            finer_surface,
            ..elastic(3.0, layers()).solids[0].clone()
        }],
        droplets: vec![],
        ..Setup::default()
    };
    let said = refused(&of(0.125, Some(false)));
    assert!(said.starts_with("bead.mesh-spacing = 0.25: its surface would have 13 points"), "{said}");
    assert!(said.contains("Use 2.03e-1 or less"), "{said}");
    assert!(of(0.1, Some(false)).build().is_ok() && of(0.125, Some(true)).build().is_ok());
}

#[test]
fn solids_that_make_no_scene_are_refused() {
    let base = elastic(3.0, plain());
    let wall = base.solids[0].clone();
    let disc = SolidOutline::Disc { centre: [0.0, 0.0], radius: 0.3 };
    let along = |factors: Vec<[f64; 2]>| Grading::Along { axis: Axis::X, factors };
    let cases = [
        (
            "solids[0].material.springs.shear = -1",
            SolidSetup { material: Material::Springs { shear: -1.0 }, ..wall.clone() },
        ),
        ("solids[0].material.neo-hookean.bulk = NaN", {
            SolidSetup { material: Material::NeoHookean { shear: 1.0, bulk: f64::NAN }, ..wall.clone() }
        }),
        ("solids[0].mesh-spacing = 0", SolidSetup { mesh_spacing: Some(0.0), ..wall.clone() }),
        ("solids[0].outline.wall-below.straight.width", SolidSetup { mesh_spacing: Some(1e-9), ..wall.clone() }),
        // Too many points along the channel, not across it.
        ("solids[0].outline.wall-below.straight.width = 6: with points 0.00005", {
            SolidSetup { mesh_spacing: Some(5.5e-5), ..wall.clone() }
        }),
        ("solids[0].outline.wall-below.straight.width = 5", {
            SolidSetup { outline: SolidOutline::WallBelow(ChannelShape::Straight { width: 5.0 }), ..wall.clone() }
        }),
        ("solids[0].hold = pinned", SolidSetup { outline: disc, ..wall.clone() }),
        (
            "solids[0].hold.tethered.stiffness = 0",
            SolidSetup { hold: Hold::Tethered { stiffness: 0.0 }, ..wall.clone() },
        ),
        ("solids[0].grading.along.factors = 0", SolidSetup { grading: along(vec![[0.0, 0.0]]), ..wall.clone() }),
        ("solids[0].grading.along.factors", {
            SolidSetup { grading: along(vec![[1.0, 1.0], [0.0, 2.0]]), ..wall.clone() }
        }),
    ];
    for (start, solid) in cases {
        let setup = Setup { solids: vec![solid], ..base.clone() };
        assert!(refused(&setup).starts_with(start), "{start}: {}", refused(&setup));
    }
}

/// A disc that is not held.
fn disc(x: f64, y: f64, radius: f64) -> SolidSetup {
    let material = Material::Springs { shear: 100.0 };
    SolidSetup { hold: Hold::Free, ..SolidSetup::new(SolidOutline::Disc { centre: [x, y], radius }, material) }
}

#[test]
fn bodies_in_one_another_are_refused_before_anything_is_meshed() {
    let grid = layers();
    let round = |x: f64, radius: f64, viscosity| DropletSetup {
        centre: [x, 0.0],
        shape: DropletShape::Round { radius },
        viscosity,
        ..DropletSetup::default()
    };
    let scene = |method, droplets: Vec<_>, solids| Setup { method, droplets, solids, ..Setup::default() };
    let only = |solids| Setup { region: channel(6.0), ..scene(grid, Vec::new(), solids) };
    for method in [grid, Method::default()] {
        let pair = |x: f64, radius: f64, viscosity| {
            scene(method, vec![round(0.0, 1.0, viscosity), round(x, radius, None)], Vec::new())
        };
        // At one place, through periods too; nearly so; crossing; crossing over the edge.
        for (x, depth) in [(0.0, ""), (6.0, ""), (1e-4, ""), (1.5, " by 0.5 "), (4.5, " by 0.5 ")] {
            let (said, start) = (refused(&pair(x, 1.0, None)), format!("droplets[1] overlaps droplets[0]{depth}"));
            assert!(said.starts_with(&start) && said.contains("Move them apart"), "{x}: {said}");
        }
        for x in [2.0, 4.0] {
            let said = refused(&pair(x, 1.0, None));
            assert!(said.starts_with("droplets[1] touches droplets[0] at ("), "{x}: {said}");
        }
        assert!(pair(2.02, 1.0, None).build().is_ok() && pair(3.98, 1.0, None).build().is_ok());
        // From within.
        for radius in [0.1, 0.3, 0.37, 0.5] {
            let said = refused(&pair(1.0 - radius, radius, None));
            assert!(said.starts_with("droplets[1] touches droplets[0] at (1"), "{radius}: {said}");
        }
        assert!(pair(0.68, 0.3, None).build().is_ok());
        for (x, radius) in [(0.2, 0.5), (2.2, 1.0)] {
            assert!([None, Some(50.0)].into_iter().all(|viscosity| pair(x, radius, viscosity).build().is_ok()));
        }
    }
    let named = |name: &str, solid: SolidSetup| SolidSetup { name: name.to_owned(), ..solid };
    let mut walls = elastic(3.0, layers()).solids;
    let material = Material::Springs { shear: 10.0 };
    let long = SolidOutline::Ellipse { centre: [0.0, 0.0], half_axes: [4.0, 0.5] };
    let cases = [
        ("solids[1] overlaps solids[0] by", only(vec![disc(0.0, 0.0, 1.0), disc(0.0, 0.0, 1.0)])),
        ("solids[1] overlaps solids[0] by", only(vec![disc(0.0, 0.0, 0.5), disc(5.2, 0.0, 0.5)])),
        ("solids[1] (lower wall) overlaps solids[0] (lower wall) by", only(vec![walls[0].clone(), walls[0].clone()])),
        ("solids[1] (disc) overlaps solids[0] (lower wall) by", {
            only(vec![walls.remove(0), named("disc", disc(1.0, -1.4, 1.0))])
        }),
        (
            "solids[0]: the body does not fit into the region of 6 x 6",
            scene(grid, Vec::new(), vec![disc(0.0, 0.0, 3.2)]),
        ),
        ("solids[0]: the body does not fit into the region of 6 x 6", {
            only(vec![SolidSetup { hold: Hold::Free, ..SolidSetup::new(long, material) }])
        }),
        ("solids[0]: the body does not fit into the region of 6 x 6", only(vec![disc(0.0, 2.7, 0.5)])),
        ("solids[0] overlaps droplets[0] by", scene(grid, vec![round(0.0, 1.0, None)], vec![disc(1.2, 0.0, 0.5)])),
        ("solids[0] overlaps droplets[0] by", scene(grid, vec![round(0.0, 0.5, None)], vec![disc(0.0, 0.0, 2.0)])),
        ("solids[0] overlaps droplets[0] by", scene(grid, vec![round(3.0, 1.0, None)], vec![disc(-3.0, 0.5, 0.8)])),
    ];
    for (start, setup) in cases {
        assert!(refused(&setup).starts_with(start), "{start}: {}", refused(&setup));
    }
    // A nucleus is where it may be.
    assert!(scene(grid, vec![round(0.0, 1.0, Some(50.0))], vec![disc(0.1, 0.0, 0.5)]).build().is_ok());
}

#[test]
fn messages_name_the_entry_and_short_numbers() {
    let modes = DropletShape::Modes { radius: 1.0, cosines: vec![0.0, 1.25], sines: Vec::new() };
    let bent = Setup { droplets: vec![DropletSetup { shape: modes, ..DropletSetup::default() }], ..Setup::default() };
    assert!(
        refused(&bent).starts_with("droplets[0]: the radius is -5.721e-4 at the polar angle"),
        "{}",
        refused(&bent)
    );
    let base = elastic(3.0, plain());
    let island = SolidOutline::Island { of: ChannelShape::Straight { width: 3.0 }, number: 3 };
    let crossing =
        SolidOutline::WallBelow(ChannelShape::Sinusoidal { width: 2.0, amplitude: 1.2, waves: 2, phase: 0.0 });
    let thin = SolidOutline::Disc { centre: [2.0, 0.0], radius: 0.01 };
    let of = |outline| {
        let hold = if matches!(outline, SolidOutline::WallBelow(_)) { Hold::Pinned } else { Hold::Free };
        Setup {
            solids: vec![SolidSetup { outline, hold, ..base.solids[0].clone() }],
            droplets: Vec::new(),
            ..base.clone()
        }
    };
    for (start, setup) in [
        ("solids[0].outline.island.number = 3: a straight channel has 0", of(island)),
        ("solids[0] (lower wall): outlines cross or touch near (", of(crossing)),
        ("solids[0] (lower wall): the solid at (2.01", of(thin)),
        (
            "region.box.lengths[0] = 1e308: use a number from 1e-50 to 1e50",
            Setup { region: Region::Box { lengths: [1e308, 1e308] }, ..Setup::default() },
        ),
        (
            "region.channel.length = 1e49: this is more than 1000 widths",
            Setup { region: Region::Channel { length: 1e49, width: 3.0, drive: Drive::ZeroFlux }, ..Setup::default() },
        ),
        ("viscosity = 1e51: use a number from 1e-50 to 1e50", Setup { viscosity: 1e51, ..Setup::default() }),
        (
            "droplets[0].shape.modes.sines = 3000 amplitudes: no method resolves so many modes",
            Setup {
                droplets: vec![DropletSetup {
                    shape: DropletShape::Modes { radius: 1.0, cosines: vec![0.0; 3], sines: vec![0.0; 3000] },
                    ..DropletSetup::default()
                }],
                ..Setup::default()
            },
        ),
        (
            "region.channel.length = 1e-300: use a number from 1e-50",
            Setup {
                region: Region::Channel { length: 1e-300, width: 3.0, drive: Drive::ZeroFlux },
                ..Setup::default()
            },
        ),
        ("region.channel.drive.gradient = NaN", {
            let region = Region::Channel { length: 6.0, width: 3.0, drive: Drive::Gradient(f64::NAN) };
            Setup { region, ..Setup::default() }
        }),
    ] {
        let said = refused(&setup);
        let long = said.split(|c: char| !(c.is_ascii_digit() || c == '.')).any(|number| number.len() > 7);
        assert!(said.starts_with(start) && !long, "{start}: {said}");
    }
}

#[test]
fn moduli_follow_their_grading() {
    let grading = Grading::Along { axis: Axis::Y, factors: vec![[-1.0, 1.0], [1.0, 3.0], [2.0, 0.5]] };
    let at = |y: f64| grading.factor(Vec2::new(9.0, y));
    for (y, factor) in [(-5.0, 1.0), (-1.0, 1.0), (0.0, 2.0), (1.0, 3.0), (1.5, 1.75), (7.0, 0.5)] {
        assert!((at(y) - factor).abs() < 1e-15, "{y}: {}", at(y));
    }
    assert_eq!(Grading::Uniform.factor(Vec2::ZERO), 1.0);
    // The energy of a wall that is stiffer by a factor everywhere is larger by it.
    let energy = |grading: Grading, material: Material| {
        let base = elastic(3.0, plain());
        let wall = SolidSetup { grading, material, ..base.solids[0].clone() };
        let mesh = wall.mesher(&base).unwrap().mesh(&wall.enclosed(&base.region).unwrap()).unwrap();
        let solid = wall.on_mesh(mesh, &base).unwrap().deformed(|s| Vec2::new(s.x, 1.1 * s.y)).unwrap();
        solid.elastic_energy().unwrap()
    };
    let (shear, bulk) = (100.0, 300.0);
    for material in [
        Material::Springs { shear },
        Material::NeoHookean { shear, bulk },
        Material::SaintVenantKirchhoff { shear, bulk },
        Material::MooneyRivlin { shear, bulk, fraction: 0.3 },
    ] {
        let graded = Grading::Along { axis: Axis::X, factors: vec![[0.0, 2.5]] };
        let (uniform, graded) = (energy(Grading::Uniform, material), energy(graded, material));
        assert!(uniform > 0.1 && (graded / uniform - 2.5).abs() < 1e-12, "{material:?}: {uniform} {graded}");
    }
}

#[test]
fn round_droplets_are_squeezed_where_they_have_no_room() {
    let area_and_height = |setup: &Setup| {
        let Built { scene, droplets, .. } = setup.build().unwrap();
        let markers = scene.body(droplets[0]).unwrap().markers().to_vec();
        let height = markers.iter().fold(0.0_f64, |most, marker| most.max(marker.y));
        (polygon_moments(&markers).unwrap().area, height)
    };
    let squeezed = |mut setup: Setup| {
        setup.droplets[0].squeezed = true;
        setup
    };
    let narrow = Setup { region: channel(2.0), ..Setup::default() };
    let wide = Setup { region: channel(3.0), ..Setup::default() };
    for (setup, half_height) in [
        (&narrow, 0.95),
        (&wide, 1.0),
        (&elastic(2.0, layers()), 0.95),
        (&elastic(2.0, plain()), 1.0),
        (&squeezed(elastic(1.6, plain())), 0.75),
    ] {
        let (area, height) = area_and_height(setup);
        assert!((height - half_height).abs() < 1e-3, "{height} {half_height}");
        // The area of the circle, but for what a polygon of 128 and more corners misses.
        assert!((area / std::f64::consts::PI - 1.0).abs() < 1e-3, "{area}");
    }
    // The film is in proportion to the radius: 0.05 of it. A circle with a gap stays one.
    for (width, half_height) in [(1.0, 0.475), (1.01, 0.5), (1.04, 0.5), (1.06, 0.5)] {
        let droplets = vec![DropletSetup::default().with_radius(0.5)];
        let (area, height) = area_and_height(&Setup { region: channel(width), droplets, ..Setup::default() });
        assert!((height - half_height).abs() < 5e-4, "{width}: {height}");
        assert!((area / (0.25 * std::f64::consts::PI) - 1.0).abs() < 1e-3, "{area}");
    }
}

/// As many particles inside as are at rest with the interface: `k_off c/k_on` times the area.
#[test]
fn the_number_inside_is_that_of_the_area() {
    for radius in [0.5, 2.0] {
        let exchange = Some(ExchangeSetup::new(0.4, 0.25));
        let particles = Some(Particles { exchange, ..Particles::default() });
        let droplets = vec![DropletSetup { particles, ..DropletSetup::default() }.with_radius(radius)];
        let setup = Setup { region: Region::Plane, droplets, ..Setup::default() };
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        let (number, _) = scene.observe(droplets[0]).unwrap().inside.unwrap();
        let exact = 0.25 * 100.0 / 0.4 * std::f64::consts::PI * radius * radius;
        assert!((number / exact - 1.0).abs() < 1e-3, "{radius}: {number} {exact}");
    }
}

/// Tethers hold a solid by its area, however many points it has.
#[test]
fn tethers_are_shared_among_the_points() {
    for spacing in [0.1, 0.2] {
        let solid = SolidSetup { hold: Hold::Tethered { stiffness: 30.0 }, ..disc(0.0, 1.9, 0.7) };
        let solids = vec![SolidSetup { mesh_spacing: Some(spacing), ..solid }];
        let setup = Setup { region: channel(6.0), method: plain(), solids, ..Setup::default() };
        let Built { scene, solids, .. } = setup.build().unwrap();
        let tethers = scene.body(solids[0]).unwrap().tethers();
        let exact = 30.0 * 0.49 * std::f64::consts::PI;
        let total: f64 = tethers.iter().map(|tether| tether.stiffness).sum();
        assert!((total / exact - 1.0).abs() < 0.02, "{spacing}: {total} {exact}");
    }
}

/// A right angle through a Gaussian of the standard deviation s moves inwards by `s/sqrt(2 pi)` along both sides.
#[test]
fn corners_of_walls_are_rounded_over_the_length() {
    let corners = vec![[1.8, -0.4], [2.6, -0.4], [2.6, 0.4], [1.8, 0.4]];
    let outline = SolidOutline::Polygon { corners, rounding: 0.0 };
    // However far apart nodes are asked for, a wall has enough of them to be one.
    let sparse = vec![WallSetup { rounding: 0.1, ..WallSetup::new(outline.clone(), 10.0) }];
    assert!(Setup { region: channel(6.0), walls: sparse, ..Setup::default() }.build().is_ok());
    for rounding in [0.05, 0.1] {
        let walls = vec![WallSetup { rounding, ..WallSetup::new(outline.clone(), 0.05) }];
        let Built { scene, .. } = Setup { region: channel(6.0), walls, ..Setup::default() }.build().unwrap();
        let tip = Vec2::new(2.6, 0.4) - Vec2::splat(rounding / std::f64::consts::TAU.sqrt());
        let boundary = scene.system().hydrodynamics().walls().unwrap();
        let nearest = boundary.corners().map(|corner| corner.distance(tip)).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-2 * rounding, "{rounding}: {nearest}");
    }
}

#[test]
fn a_misplaced_droplet_is_refused_and_not_squeezed() {
    let at = |width: f64, y: f64| Setup {
        region: channel(width),
        droplets: vec![DropletSetup { centre: [0.0, y], ..DropletSetup::default() }],
        ..Setup::default()
    };
    for y in [0.7, -0.9, 1.2] {
        assert!(refused(&at(3.0, y)).starts_with("droplets[0]: the body does not fit into the region of 6 x 3"), "{y}");
        let mut elastic = Setup { droplets: at(3.0, y).droplets, ..elastic(3.0, layers()) };
        assert!(refused(&elastic).contains(" overlaps droplets[0] by"), "{y}: {}", refused(&elastic));
        elastic.solids.clear();
        assert!(elastic.build().is_ok());
    }
    // A circle next to a wall stays one, and may not touch the wall.
    for method in [Method::default(), layers(), plain()] {
        let near = Setup { method, ..at(3.0, 0.47) };
        assert_eq!(near.shape(&near.droplets[0]).unwrap(), DropletShape::Round { radius: 1.0 });
        let Built { mut scene, .. } = near.build().unwrap();
        // The polygon through the markers has the area of the circle, and corners outside of it.
        let gap = scene.system_mut().wall_gap().unwrap();
        assert!((gap - 0.03).abs() < 5e-4, "{gap}");
    }
    let touching = refused(&at(3.0, 0.5));
    assert!(touching.starts_with("droplets[0]: the body does not fit into the region of 6 x 3"), "{touching}");
    let post = |x: f64, y: f64| {
        let disc = SolidOutline::Disc { centre: [x, y], radius: 0.5 };
        Setup { walls: vec![WallSetup::new(disc, 0.05)], ..at(6.0, 0.0) }
    };
    assert!(refused(&post(0.0, -1.5)).starts_with("droplets[0]: the body does not fit"));
    // An obstacle inside the droplet or its image, and one in its side, where a squeezed droplet would be wider.
    for (x, y, start) in [
        (0.1, 0.2, "droplets[0] contains walls[0]. Move one of them"),
        (5.9, 0.2, "droplets[0] contains walls[0]. Move one of them"),
        (1.3, 0.0, "droplets[0] overlaps walls[0] by 0.2 at (1.0000, 0.0000)"),
        (0.0, 0.0, "droplets[0] contains walls[0]. Move one of them"),
    ] {
        for squeezed in [false, true] {
            let mut setup = post(x, y);
            setup.droplets[0].squeezed = squeezed;
            assert!(refused(&setup).starts_with(start), "{x} {y}: {}", refused(&setup));
            setup.droplets[0].shape = DropletShape::Ellipse { half_axes: [1.0, 1.0] };
            assert!(refused(&setup).starts_with(start), "{x} {y}: {}", refused(&setup));
        }
    }
    for setup in [post(1.53, 0.0), post(0.0, -1.53)] {
        assert_eq!(setup.shape(&setup.droplets[0]).unwrap(), DropletShape::Round { radius: 1.0 });
    }
    // Where no place has room for the circle it may be squeezed wherever it is.
    let mut aside = at(2.0, 0.3);
    let error = refused(&aside);
    assert!(
        error.contains("a round droplet of radius 1 does not fit between the walls and obstacles: they leave 0.7"),
        "{error}"
    );
    aside.droplets[0].squeezed = true;
    assert!(aside.build().is_ok());
}

/// A round droplet that is wider than its surroundings is refused, in a channel of rigid or elastic walls and in a
/// tube, unless it is to be squeezed; what it starts as then is told by its shape.
#[test]
fn round_droplets_are_squeezed_only_on_request() {
    let tube = Region::Tube { radius: 0.5, shape: Default::default(), drive: Drive::ZeroFlux, length: None };
    let of = |region| Setup { region, ..Setup::default() };
    for (setup, expected) in [
        (of(channel(0.5)), Some((0.2, Squeezed::Ellipse))),
        (of(channel(1.9)), Some((0.9, Squeezed::Ellipse))),
        (of(tube), Some((0.45, Squeezed::Ellipse))),
        (elastic(1.0, layers()), Some((0.45, Squeezed::Stadium))),
        (elastic(1.6, plain()), Some((0.75, Squeezed::Stadium))),
        (of(channel(2.2)), None),
    ] {
        let mut setup = setup;
        let shape = |setup: &Setup| setup.shape(&setup.droplets[0]).map_err(|error| error.to_string());
        let Some((half, kind)) = expected else {
            assert_eq!(shape(&setup), Ok(DropletShape::Round { radius: 1.0 }));
            continue;
        };
        let error = shape(&setup).unwrap_err();
        assert!(error.contains("or add `squeezed = true` to the droplet"), "{error}");
        assert!(setup.build().is_err_and(|error| error.to_string().starts_with("droplets[0]: a round droplet")));
        setup.droplets[0].squeezed = true;
        let Ok(DropletShape::Squeezed { radius, half_height, to }) = shape(&setup) else { panic!("{setup:?}") };
        assert!(radius == 1.0 && (half_height - half).abs() < 1e-12 && to == kind, "{half_height} {half}");
    }
}

#[test]
fn bodies_stand_in_the_order_of_the_description() {
    let droplets = ["a", "b"].map(|name| {
        let centre = [if name == "a" { -1.5 } else { 1.5 }, 0.0];
        let shape = DropletShape::Round { radius: 0.6 };
        DropletSetup { name: name.to_owned(), centre, shape, ..DropletSetup::default() }
    });
    let core = SolidSetup {
        hold: Hold::Free,
        name: "core".to_owned(),
        ..SolidSetup::new(
            SolidOutline::Disc { centre: [1.5, 0.0], radius: 0.3 },
            Material::MooneyRivlin { shear: 100.0, bulk: 200.0, fraction: 0.5 },
        )
    };
    let mut setup = Setup { droplets: droplets.to_vec(), ..elastic(3.0, layers()) };
    setup.solids.push(core);
    let Built { mut scene, droplets, solids, .. } = setup.build().unwrap();
    let names: Vec<&str> = droplets.iter().map(|&handle| scene.body(handle).unwrap().name()).collect();
    assert_eq!(names, ["a", "b"]);
    let names: Vec<&str> = solids.iter().map(|&handle| scene.body(handle).unwrap().name()).collect();
    assert_eq!(names, ["lower wall", "upper wall", "core"]);
    scene.step(1e-3).unwrap();
}

#[test]
fn cores_lie_inside_droplets_and_nothing_inside_rigid_ones() {
    let inside = |method: Method, radius: f64, centre: [f64; 2]| Setup {
        method,
        rigid_bodies: vec![RigidBodySetup { centre, ..RigidBodySetup::disc(radius) }],
        shells: vec![ShellSetup {
            centre: [0.5, 0.0],
            shape: DropletShape::Round { radius: 0.2 },
            ..ShellSetup::default()
        }],
        ..Setup::default()
    };
    let integral = Method::Integral(IntegralMethod { nodes: 32, elements: 64 });
    let layers = LayersMethod { nodes: 32, elements: 64, ..LayersMethod::of_spacing(0.2) };
    for method in [integral, Method::Layers(layers)] {
        let Built { mut scene, droplets, rigid_bodies, shells, .. } = inside(method, 0.3, [-0.4, 0.1]).build().unwrap();
        scene.step(1e-3).unwrap();
        let gap = |body: Handle<dyn Body>| scene.system().gap(droplets[0], body).unwrap().unwrap();
        assert!(gap(rigid_bodies[0].into()) > 0.1 && gap(shells[0].into()) > 0.1);
    }
    let said = refused(&inside(integral, 0.3, [0.5, 0.1]));
    assert!(said.starts_with("shells[0] overlaps rigid-bodies[0] by"), "{said}");
    let said = refused(&inside(integral, 0.3, [0.9, 0.1]));
    assert!(said.contains("rigid-bodies[0] overlaps droplets[0]"), "{said}");
    let mut pulled = Setup { region: Region::Plane, ..inside(integral, 0.3, [-0.4, 0.1]) };
    pulled.rigid_bodies[0].force = [1.0, 0.0];
    assert!(
        refused(&pulled).starts_with("rigid-bodies[0].force = 1: in the plane nothing holds"),
        "{}",
        refused(&pulled)
    );
    pulled.shells[0].bending = -1.0;
    pulled.rigid_bodies.clear();
    assert!(refused(&pulled).starts_with("shells[0].bending = -1"), "{}", refused(&pulled));
}

#[cfg(feature = "toml")]
#[test]
fn the_solver_on_a_grid_is_chosen_by_its_key() {
    let scene = |solver: &str| {
        let grid = format!("{{ spacing = 0.2, corrected = false, solver = \"{solver}\" }}");
        Setup::from_toml(&format!("region.channel = {{ length = 4.0, width = 2.4 }}\nmethod = {{ grid = {grid} }}"))
    };
    let solvers = [GridSolver::Streamfunction, GridSolver::Projection, GridSolver::LaggedProjection];
    let names = ["streamfunction", "projection", "lagged-projection"];
    for (solver, name) in solvers.into_iter().zip(names) {
        let Method::Grid(grid) = scene(name).unwrap().method else { panic!("another method") };
        assert_eq!(grid.solver, solver);
    }
    assert_eq!(GridMethod::default().solver, GridSolver::Streamfunction);
    assert_eq!(GridMethod::thesis().solver, GridSolver::LaggedProjection);
    let error = scene("spectral").unwrap_err().to_string();
    assert!(error.contains("spectral") && error.contains("lagged-projection"), "{error}");
}

/// A droplet in a channel or box by each solver, in steps of 0.01; returns its markers and transforms per evaluation.
fn swum(setup: &Setup, solver: GridSolver) -> (Vec<Vec2>, usize) {
    let grid = GridMethod { spacing: 0.2, solver, ..GridMethod::thesis() };
    let setup = Setup { method: Method::Grid(grid), step: StepSize::Fixed(0.01), ..setup.clone() };
    let Built { mut scene, droplets, .. } = setup.build().unwrap();
    scene.run(0.2).go().unwrap();
    let work = scene.system().hydrodynamics().work();
    (scene.body(droplets[0]).unwrap().markers().to_vec(), work.transforms / work.evaluations)
}

fn farthest(one: &[Vec2], other: &[Vec2]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

#[test]
fn scenes_by_projection_are_those_by_streamfunction_except_for_lagging_walls() {
    use GridSolver::{LaggedProjection, Projection, Streamfunction};
    let in_box = Setup::thesis();
    let in_channel = Setup { region: channel(2.4), ..Setup::thesis() };
    for (setup, transforms, lags) in [(&in_box, 6, false), (&in_channel, 4, true)] {
        let (expected, pair) = swum(setup, Streamfunction);
        let (exact, found) = swum(setup, Projection);
        let (lagged, _) = swum(setup, LaggedProjection);
        assert_eq!((pair, found), (2, transforms));
        assert!(farthest(&exact, &expected) < 1e-11, "{:e}", farthest(&exact, &expected));
        let lag = farthest(&lagged, &exact);
        if lags {
            assert!((1e-7..1e-3).contains(&lag), "{lag:e}");
        } else {
            assert_eq!(lag, 0.0);
        }
    }
    // Flows that are iterated have exact walls.
    let droplet = DropletSetup { viscosity: Some(300.0), ..DropletSetup::thesis() };
    let contrast = Setup { droplets: vec![droplet], ..in_channel };
    assert_eq!(swum(&contrast, LaggedProjection).0, swum(&contrast, Projection).0);
}

#[test]
fn fingerprints_tell_scenes_apart_but_not_steps() {
    let setup = Setup::default();
    assert_eq!(setup.fingerprint(), Setup { step: StepSize::Fixed(1e-3), ..Setup::default() }.fingerprint());
    for other in [
        Setup { viscosity: 100.000_000_1, ..Setup::default() },
        Setup { droplets: vec![DropletSetup::active(-2.1)], ..Setup::default() },
        Setup { method: Method::Grid(GridMethod::default()), ..Setup::default() },
    ] {
        assert_ne!(setup.fingerprint(), other.fingerprint());
    }
}

#[cfg(feature = "toml")]
mod file {
    use super::*;

    fn varied() -> Setup {
        let shapes = [
            DropletShape::Squeezed { radius: 1.0, half_height: 0.7, to: Squeezed::Stadium },
            DropletShape::Ellipse { half_axes: [1.2, 0.8] },
            DropletShape::Modes { radius: 1.0, cosines: vec![0.0, 0.1], sines: vec![0.05] },
            DropletShape::Points((0..9).map(|k| f64::from(k) * 0.69).map(|t| [t.cos(), t.sin()]).collect()),
        ];
        let mut setup = elastic(3.0, plain());
        setup.region = Region::Channel { length: 40.0, width: 5.0, drive: Drive::Flux(-0.25) };
        setup.step = StepSize::Adaptive { tolerance: 1e-4 };
        setup.repulsion = Some(Repulsion::new(2.0, 0.1).unwrap());
        setup.least_gap = Some(0.01);
        setup.droplets.extend(shapes.into_iter().enumerate().map(|(k, shape)| DropletSetup {
            centre: [4.0 * k as f64 - 16.0, 0.1],
            shape,
            viscosity: Some(7.5),
            ..DropletSetup::thesis()
        }));
        setup.droplets.push(DropletSetup { centre: [12.0, 0.0], ..DropletSetup::passive(3.0) });
        setup.droplets[1].particles = Some(Particles {
            excluded_volume: ExcludedVolume::Quadratic(0.1),
            start: Start::Perturbed { amplitude: 0.05, seed: i64::MAX as u64 },
            ..Particles::default()
        });
        let graded = Grading::Along { axis: Axis::X, factors: vec![[0.0, 1.0], [3.0, 2.0]] };
        let start = DirectorStart::Uniform { angle: 0.3, noise: 0.2, seed: 9 };
        setup.droplets[2].gel =
            Some(GelSetup { anchoring: motile_interior::Anchoring::Planar, start, ..GelSetup::default() });
        setup.droplets[3].gel = Some(GelSetup { start: DirectorStart::Aster, ..GelSetup::default() });
        setup.droplets[2..4].iter_mut().for_each(|droplet| droplet.motion = Motion::default());
        setup.solids.push(SolidSetup {
            hold: Hold::Tethered { stiffness: 20.0 },
            grading: graded,
            mesh: MeshKind::Unstructured,
            mesh_spacing: Some(0.07),
            ..SolidSetup::new(
                SolidOutline::Polygon { corners: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], rounding: 0.1 },
                Material::SaintVenantKirchhoff { shear: 10.0, bulk: 30.0 },
            )
        });
        let shape = DropletShape::Ellipse { half_axes: [0.3, 0.2] };
        setup.shells.push(ShellSetup { centre: [16.0, 0.1], shape, viscosity: Some(2.0), ..ShellSetup::default() });
        setup
    }

    #[test]
    fn what_is_written_is_read() {
        let passive = Setup { droplets: vec![DropletSetup::passive(3.0)], ..Setup::default() };
        let mut layers = varied();
        layers.droplets.iter_mut().for_each(|droplet| (droplet.viscosity, droplet.gel) = (None, None));
        layers.rigid_bodies.push(RigidBodySetup { torque: 0.1, ..RigidBodySetup::disc(0.2) });
        layers.solids.iter_mut().for_each(|solid| solid.mesh_spacing = None);
        layers.method = super::layers();
        let distributed = SuspensionSetup {
            count: Some(7),
            radius: Some(Distribution::Normal { mean: 1.0, deviation: 0.1 }),
            activity: Some(Distribution::Between([-3.0, -2.0])),
            viscosity: Some(Distribution::Value(1000.0)),
            headings: Headings::Aligned(0.5),
            arrangement: Arrangement::Lattice,
            ..SuspensionSetup::default()
        };
        let suspended = Setup { droplets: vec![], suspension: vec![distributed], ..Setup::default() };
        let filled =
            Setup { method: plain(), droplets: vec![], gels: vec![GelInBoxSetup::default()], ..Setup::default() };
        for setup in
            [Setup::default(), passive, Setup::thesis(), elastic(2.0, plain()), varied(), layers, filled, suspended]
        {
            let text = setup.to_toml().unwrap();
            assert_eq!(Setup::from_toml(&text).unwrap(), setup, "{text}");
        }
    }

    #[test]
    fn what_is_left_out_is_the_default() {
        let text = "[[droplets]]\n[droplets.particles]\n";
        assert_eq!(Setup::from_toml(text).unwrap(), Setup::default());
        assert_eq!(Setup::from_toml("").unwrap(), Setup { droplets: Vec::new(), ..Setup::default() });
        let stiff = Setup::from_toml("integrator = \"runge-kutta-chebyshev\"").unwrap();
        assert_eq!(stiff.integrator, IntegratorKind::RungeKuttaChebyshev);
        assert_eq!(stiff.build().unwrap().scene.integrator().name(), "the Runge-Kutta-Chebyshev method");
        let active = Setup::from_toml("[[droplets]]\ntension = 3.0\n").unwrap();
        assert_eq!(active.droplets, [DropletSetup { tension: 3.0, ..DropletSetup::default() }]);
        let passive = Setup::from_toml("[[droplets]]\ntension = 3.0\nparticles = \"none\"\n").unwrap();
        assert_eq!(passive.droplets, [DropletSetup::passive(3.0)]);
        let constriction = "{ width = 3.0, throat = 1.0, throat-length = 2.0, ramp = 1.0 }";
        let text = format!(
            "region.channel = {{ length = 12.0, width = 5.0 }}\nmethod.layers = {{}}\n[[solids]]\n\
             outline.wall-below.constriction = {constriction}\nmaterial.springs.shear = 10.0"
        );
        let shape = ChannelShape::Constriction {
            width: 3.0,
            throat: 1.0,
            throat_length: 2.0,
            ramp: 1.0,
            exit_ramp: None,
            centre: 0.0,
        };
        assert_eq!(Setup::from_toml(&text).unwrap().solids[0].outline, SolidOutline::WallBelow(shape));
    }

    #[test]
    fn mistakes_are_named_with_their_place() {
        for (text, parts) in [
            ("viscosty = 3.0", &["line 1", "unknown key `viscosty`", "`viscosity`"][..]),
            ("[[droplets]]\nparticles.activty = -1.0", &["line 2", "unknown key `activty`"]),
            ("[[droplets]]\nparticles = \"nothing\"", &["line 2", "\"none\" for a passive droplet"]),
            (
                "[[droplets]]\nshape.ellipse.half_axes = [1.0, 1.0]",
                &["line 2", "unknown key `half_axes`, expected `half-axes`"],
            ),
            ("[method.grid]\nspacing = \"fine\"", &["line 2", "spacing"]),
            ("[region.pipe]\nlength = 3.0", &["unknown choice `pipe`", "channel"]),
            ("[region.channel]\nlength = 3.0", &["missing required key `width`"]),
            ("region.plane = 3.0", &["line 1, column 16", "no settings", "its name only"]),
            ("region = \"box\"", &["line 1, column 10", "has settings", "choice = settings"]),
            ("[region]\nbox.lengths = [6, 6]\nspace = {}", &["line 1", "2 entries", "Give one"]),
            ("region = 6", &["line 1, column 10", "integer `6`, expected the name of a choice"]),
            ("step.fixed = \"short\"", &["line 1, column 14", "string \"short\", expected a number"]),
            ("[[droplets]]\ncentre = [1]", &["line 2, column 10", "expected an array of length 2"]),
            ("[[droplets]]\ncentre = [1, true]", &["line 2, column 14", "boolean `true`, expected a number"]),
            ("droplets = 3", &["line 1, column 12", "expected a list"]),
            ("droplets = [[1]]", &["line 1, column 13", "sequence, expected struct"]),
            ("method.integral = { nodes = -4 }", &["line 1, column 29", "whole number that is not negative"]),
            ("viscosity = 1979-05-27", &["line 1, column 13", "date, expected a number"]),
            ("viscosity = 1e999", &["line 1, column 13", "too large"]),
            ("viscosity = -3.0", &["viscosity = -3", "positive"]),
            ("viscosity = nan", &["viscosity = NaN", "positive"]),
            ("[[droplets]]\nparticles.diffusion = -1.0", &["droplets[0].particles.diffusion = -1"]),
            ("method.grid.spacing = 0.07", &["method.grid.spacing = 0.07", "whole number"]),
            ("viscosity = ", &["line 1"]),
            ("method.grid.contrast = \"sharp\"", &["method.grid.contrast", "[method.layers]", "take the entry away"]),
            ("[repulsion]\nstrength = 1.0\nrange = 0.0", &["repulsion.range = 0", "positive"]),
            ("[[rigid]]\nspacing = 0.1", &["rigid = [", "[[walls]]"]),
            ("method.grid.filter = false", &["method.grid.filter = false", "droplets.motion.equidistributed = {"]),
            (
                "[[solids]]\noutline.polygon = { corners = [[0.0, 0.0]], fillet = 0.1 }\nmaterial.springs.shear = 1.0",
                &["fillet", "rounding"],
            ),
            (
                "method.grid.layers.nodes = 72",
                &["method.grid.layers", "set nodes and elements in [method.layers] instead"],
            ),
            (
                "[[solids]]\nsurface = \"plain\"\noutline.disc = { centre = [0.0, 0.0], radius = 0.3 }\n\
                 material.springs.shear = 1.0",
                &["solids[0].surface = \"plain\"", "[method.grid] with corrected = false"],
            ),
        ] {
            let error = Setup::from_toml(text).unwrap_err().to_string();
            assert!(parts.iter().all(|part| error.contains(part)), "{text}: {error}");
        }
    }

    /// The problem is told without a copy of a long line.
    #[test]
    fn long_lines_are_not_copied() {
        let long = "x".repeat(20_000);
        for (text, part) in [
            (format!("region = \"plane\"\nfoo = \"{long}\""), "line 2, column 1"),
            (format!("region = \"plane\" {long}"), "line 1, column 18"),
            (format!("{long} = 1"), "unknown key"),
            (format!("region = \"{long}\""), "unknown choice"),
            (format!("method.integral = {{ nodes = 64, {} }}", "elements = 3, ".repeat(2000)), "duplicate key"),
            (format!("viscosity = {}", "9".repeat(20_000)), "line 1, column"),
        ] {
            let error = Setup::from_toml(&text).unwrap_err().to_string();
            assert!(error.contains(part) && error.len() < 1000, "{error}");
        }
    }

    const ANNOTATED: &str = Setup::ANNOTATED;

    /// The annotated scene, and it with each of the other values that its lines name in their place.
    fn annotated() -> Vec<toml::Value> {
        let scene: toml::Value = ANNOTATED.parse::<toml::Table>().unwrap().into();
        let others =
            ANNOTATED.lines().filter_map(|line| line.strip_prefix("#| ")?.split_once(" = ")).map(|(keys, value)| {
                let mut changed = scene.clone();
                let place = keys.split('.').fold(&mut changed, |value, key| {
                    let table = if value.is_array() { &mut value[0] } else { value };
                    table.as_table_mut().unwrap().entry(key).or_insert_with(|| toml::Table::new().into())
                });
                *place = format!("x = {value}").parse::<toml::Table>().unwrap()["x"].clone();
                changed
            });
        [scene.clone()].into_iter().chain(others).collect()
    }

    /// Calls `visit` with the keys down to each value of a document, without the numbers of lists.
    fn visit_values(value: &toml::Value, keys: &[String], visit: &mut dyn FnMut(&[String])) {
        visit(keys);
        let children: Vec<(String, &toml::Value)> = match value {
            toml::Value::Table(table) => table.iter().map(|(key, value)| (key.clone(), value)).collect(),
            toml::Value::Array(list) => list.iter().enumerate().map(|(k, value)| (k.to_string(), value)).collect(),
            _ => Vec::new(),
        };
        for (key, value) in children {
            visit_values(value, &[keys, &[key]].concat(), visit);
        }
    }

    fn value_at<'a>(document: &'a mut toml::Value, keys: &[String]) -> &'a mut toml::Value {
        keys.iter().fold(document, |value, key| match key.parse::<usize>() {
            Ok(number) => &mut value[number],
            Err(_) => &mut value[key.as_str()],
        })
    }

    /// Names that an error says could have been given.
    fn expected(error: &str) -> Vec<&str> {
        let line = error.lines().next().unwrap();
        match (line.split_once("expected"), line.split_once("available keys: ")) {
            (_, Some((_, names))) => names.split(", ").collect(),
            (Some((_, names)), _) => names.split('`').skip(1).step_by(2).collect(),
            _ => Vec::new(),
        }
    }

    #[test]
    fn the_annotated_scene_is_one_and_shows_every_key() {
        let built = Setup::from_toml(ANNOTATED).unwrap().build().unwrap();
        assert_eq!((built.droplets.len(), built.solids.len(), built.shells.len()), (2, 1, 1));
        let (mut shown, mut wanted) = (std::collections::BTreeSet::new(), std::collections::BTreeSet::new());
        for document in annotated() {
            let read = |document: toml::Value| document.try_into::<Setup>().map_err(|error| error.to_string());
            let described = read(document.clone()).unwrap();
            assert_eq!(Setup::read(&document.as_table().unwrap().to_string()), Ok(described));
            visit_values(&document, &[], &mut |keys| {
                let mut changed = document.clone();
                let value = value_at(&mut changed, keys);
                shown.extend(keys.last().cloned());
                shown.extend(value.as_str().map(str::to_owned));
                // A key that does not exist, and a value that does not.
                let is_table = value.as_table_mut().map(|table| table.insert("zzz".to_owned(), 0.into())).is_some();
                let refused = [is_table.then(|| read(changed.clone()).unwrap_err()), {
                    *value_at(&mut changed, keys) = "zzz".into();
                    read(changed).err()
                }];
                wanted.extend(refused.iter().flatten().flat_map(|error| expected(error)).map(str::to_owned));
            });
        }
        let missing: Vec<_> = wanted.difference(&shown).collect();
        assert!(wanted.len() > 150 && missing.is_empty(), "{} {missing:?}", wanted.len());
    }

    /// Keys that a resumed run may change.
    fn may_change(key: &str) -> bool {
        let ends = ["particles.flux", "spacing", "kernel", "corrected", "solver"];
        let method = key.starts_with("method.") && !key.ends_with("marker-spacing");
        ["integrator", "tolerance", "least-gap"].contains(&key)
            || key.starts_with("step.")
            || key.ends_with(ends[0])
            || method && ends[1..].iter().any(|end| key.ends_with(end))
    }

    /// The refusal of a checkpoint of the description `saved` in a scene of `here`.
    fn refusal_of_resuming(saved: &Setup, here: &Setup) -> Option<String> {
        let scene =
            |setup: &Setup| Scene::new(motile_scene::Substrate::new(1.0).unwrap()).described_by(setup.entries());
        scene(here).resume(&scene(saved).checkpoint("")).err().map(|error| error.to_string())
    }

    /// Of a flow that is given on one side alone the error names what is not zero.
    #[test]
    fn the_key_of_a_new_flow_is_named() {
        let of = |shear: f64| Setup { flow: FlowSetup { shear, ..FlowSetup::default() }, ..Setup::default() };
        let refused = refusal_of_resuming(&of(0.0), &of(0.1)).unwrap();
        assert!(refused.contains("flow.shear is not given in it and 0.1 here"), "{refused}");
        assert!(refused.contains("`Scene::take_over`"), "{refused}");
        let refused = refusal_of_resuming(&of(0.1), &of(0.0)).unwrap();
        assert!(refused.contains("flow.shear is 0.1 in it and not given here"), "{refused}");
    }

    /// Each key of the annotated scene, changed in a scene that resumes: refused with both values, or free to change.
    #[test]
    fn every_key_is_compared_by_resumed_runs_or_free_to_change() {
        let read = |document: &toml::Value| document.clone().try_into::<Setup>().unwrap();
        let documents = annotated();
        let base = read(&documents[0]);
        let (mut refused, mut free) = (std::collections::BTreeSet::new(), std::collections::BTreeSet::new());
        for document in &documents {
            let saved = read(document);
            assert_eq!(refusal_of_resuming(&saved, &saved), None);
            visit_values(document, &[], &mut |keys| {
                let mut changed = document.clone();
                let value = value_at(&mut changed, keys);
                let [before, after] = match value.clone() {
                    toml::Value::Float(number) => [number.to_string(), (1.01 * number + 0.003).to_string()],
                    // Whole numbers where a number of any kind may stand are read as such.
                    toml::Value::Integer(number) => [number.to_string(), (number + 1).to_string()],
                    toml::Value::Boolean(flag) => [flag.to_string(), (!flag).to_string()],
                    toml::Value::String(_) if keys.last().is_some_and(|key| key == "name") => {
                        ["\"".to_owned(), "\"zzz\"".to_owned()]
                    }
                    _ => return,
                };
                *value = format!("x = {after}").parse::<toml::Table>().unwrap()["x"].clone();
                let key = keys.iter().fold(String::new(), |key, part| match part.parse::<usize>() {
                    Ok(number) => format!("{key}[{number}]"),
                    Err(_) if key.is_empty() => part.clone(),
                    Err(_) => format!("{key}.{part}"),
                });
                match refusal_of_resuming(&saved, &read(&changed)) {
                    None => assert!(may_change(&key) && free.insert(key.clone()) | true, "{key} is not compared"),
                    Some(said) => {
                        let words = format!("the checkpoint is of another description: {key} is ");
                        assert!(!may_change(&key) && said.starts_with(&words), "{key}: {said}");
                        assert!(said.contains(&before) && said.contains(&after), "{key}: {said}");
                        refused.insert(key);
                    }
                }
            });
            // Another value in place of one of the annotated scene.
            if saved != base {
                let differs = |key: &str| {
                    let [a, b] = [document, &documents[0]].map(|document| document.get(key));
                    a != b
                };
                let key =
                    ["method", "droplets", "interfaces", "integrator", "step"].into_iter().find(|key| differs(key));
                let numerics = Setup { step: base.step, integrator: base.integrator, ..saved.clone() };
                let said = refusal_of_resuming(&saved, &base);
                assert!(said.is_some() || numerics == base || numerics.entries() == base.entries(), "{key:?}");
            }
        }
        assert!(refused.len() > 150 && free.len() >= 7, "{} {}", refused.len(), free.len());
    }
}

#[test]
fn numbers_of_shapes_and_shells_are_named() {
    let droplet = |shape| DropletSetup { shape, ..DropletSetup::default() };
    let squeezed = |radius, half_height| DropletShape::Squeezed { radius, half_height, to: Squeezed::Ellipse };
    let ellipse = |half_axes| {
        let outline = SolidOutline::Ellipse { centre: [0.0; 2], half_axes };
        let solids = vec![SolidSetup::new(outline, Material::Springs { shear: 1.0 })];
        Setup { method: layers(), droplets: Vec::new(), solids, ..Setup::default() }
    };
    let polygon = |corner: [f64; 2], rounding: f64| {
        let outline = SolidOutline::Polygon { corners: vec![[2.0, -0.5], corner, [2.0, 0.5]], rounding };
        Setup { region: channel(6.0), walls: vec![WallSetup::new(outline, 0.1)], ..Setup::default() }
    };
    let cases = [
        (
            "droplets[0].shape.squeezed.radius = -1",
            Setup { droplets: vec![droplet(squeezed(-1.0, 0.5))], ..Setup::default() },
        ),
        ("shells[0].viscosity = 0", {
            let shells = vec![ShellSetup { viscosity: Some(0.0), ..ShellSetup::default() }];
            Setup { droplets: Vec::new(), shells, ..Setup::default() }
        }),
        ("solids[0].outline.ellipse.half-axes = 0", ellipse([0.0, 0.5])),
        ("walls[0].outline.polygon.corners[1][0] = NaN", polygon([f64::NAN, 0.0], 0.0)),
        ("walls[0].outline.polygon.rounding = NaN", polygon([3.0, 0.0], f64::NAN)),
        ("walls[0].outline.polygon.rounding = -0.1", polygon([3.0, 0.0], -0.1)),
        ("walls[0].outline.disc.radius = 0", {
            let disc = SolidOutline::Disc { centre: [0.0; 2], radius: 0.0 };
            Setup { region: channel(6.0), walls: vec![WallSetup::new(disc, 0.1)], ..Setup::default() }
        }),
        ("droplets[0] overlaps walls[1] by", {
            let walls = WallSetup::channel(&ChannelShape::Straight { width: 3.0 }, 0.15);
            let droplets =
                vec![DropletSetup { centre: [0.0, 1.0], ..droplet(DropletShape::Ellipse { half_axes: [1.0; 2] }) }];
            Setup { region: channel(6.0), walls, droplets, ..Setup::default() }
        }),
    ];
    for (start, setup) in cases {
        assert!(refused(&setup).starts_with(start), "{start}: {}", refused(&setup));
    }
    #[cfg(feature = "toml")]
    assert!(Setup::from_toml("viscosity = -1.0").unwrap_err().to_string().starts_with("viscosity = -1"));
}

/// The points of an interface may be given from either end.
#[test]
fn interfaces_through_points_from_either_end() {
    let points: Vec<[f64; 2]> = (0..40)
        .map(|k| 0.15 * f64::from(k) - 3.0)
        .map(|x| [x, 0.3 * (std::f64::consts::TAU * x / 6.0).sin()])
        .collect();
    let made = |points: Vec<[f64; 2]>| {
        let interfaces = vec![InterfaceSetup { shape: InterfaceShape::Points(points), ..InterfaceSetup::default() }];
        let setup = Setup { droplets: Vec::new(), interfaces, ..Setup::default() };
        setup.build().unwrap().scene.system().markers().positions().to_vec()
    };
    let reversed = points.iter().rev().copied().collect();
    for (one, other) in made(points).iter().zip(made(reversed)) {
        assert!((one.y - other.y).abs() < 1e-9 && (one.x - other.x).abs() < 1e-9, "{one:?} {other:?}");
    }
}

/// The energy of bending takes three markers for each two nodes.
#[test]
fn droplets_that_bend_have_markers_enough() {
    let method = Method::Integral(IntegralMethod { nodes: 48, elements: 48 });
    let setup = Setup { method, ..Setup::default() };
    let markers = |bending: f64| {
        let droplet = DropletSetup { bending, ..DropletSetup::passive(1.0) };
        setup.droplet(&droplet).unwrap().markers().len()
    };
    assert_eq!([markers(0.0), markers(0.1)], [48, 72]);
}

/// Boxes that a droplet fills, and regions too slender for integrals, are refused with their keys.
#[test]
fn narrow_regions_are_refused() {
    let method = Method::Integral(IntegralMethod { nodes: 48, elements: 72 });
    let of = |region: Region| Setup { region, method, ..Setup::default() };
    let error = refused(&of(Region::Box { lengths: [2.0, 2.0] }));
    assert!(error.contains("droplets[0]") && error.contains("does not fit into the region of 2 x 2"), "{error}");
    let error = refused(&of(Region::Box { lengths: [60.0, 2.5] }));
    assert!(error.starts_with("region.box.lengths[1] = 2.5: "), "{error}");
    let error = refused(&of(Region::Channel { length: 1e-60, width: 4.0, drive: Drive::ZeroGradient }));
    assert!(error.starts_with("region.channel.length = 1e-60: "), "{error}");
    let poiseuille = Some(PoiseuilleSetup { speed: 1.0, half_width: 1e-300 });
    let error = refused(&Setup { flow: FlowSetup { poiseuille, ..FlowSetup::default() }, ..of(Region::Plane) });
    assert!(error.starts_with("flow.poiseuille.half-width = 1e-300: "), "{error}");
}

/// A flux is given for layers of one viscosity, whether an interface names its own or not.
#[test]
fn a_flux_is_that_of_one_viscosity() {
    let made = |viscosity: Option<f64>| {
        let interfaces = vec![InterfaceSetup { viscosity, ..InterfaceSetup::default() }];
        let region = Region::Channel { length: 6.0, width: 3.0, drive: Drive::Flux(0.5) };
        Setup { region, droplets: Vec::new(), interfaces, ..Setup::default() }.check()
    };
    let same = Setup::default().viscosity;
    assert!(made(None).is_ok() && made(Some(same)).is_ok());
    let error = made(Some(2.0 * same)).unwrap_err().to_string();
    assert!(error.contains("flux = 0.5") && error.contains("different viscosity"), "{error}");
}

/// An integrator without implicit parts takes neither particles alone nor a gel alone.
#[test]
fn what_diffuses_is_refused_where_it_is_not_stepped() {
    let of = |droplet: DropletSetup| {
        Setup { integrator: IntegratorKind::RungeKutta, droplets: vec![droplet], ..Setup::default() }.check()
    };
    assert!(of(DropletSetup::passive(1.0)).is_ok());
    let error = of(DropletSetup::active(-1.0)).unwrap_err().to_string();
    assert!(error.starts_with("integrator = runge-kutta"), "{error}");
}

/// Half as many markers again as there may be, by a spacing that is too fine.
#[test]
fn a_droplet_of_too_many_markers_is_refused() {
    let of = |part: f64| {
        let marker_spacing = Some(std::f64::consts::TAU / (part * IntegralMethod::MOST_ELEMENTS as f64));
        let method = Method::Grid(GridMethod { marker_spacing, ..GridMethod::of_spacing(0.1) });
        let setup = Setup { method, ..Setup::default() };
        setup.marker_count(&Curve::circle(1.0).unwrap(), "the droplet").map_err(|error| error.to_string())
    };
    assert!(of(0.9).is_ok_and(|count| count as f64 >= 0.9 * IntegralMethod::MOST_ELEMENTS as f64));
    let said = of(1.5).unwrap_err();
    assert!(said.starts_with("method.grid.marker-spacing = ") && said.contains("the droplet would have"), "{said}");
}

/// Volume, and area of the surface, of a body of revolution by the polygon of its meridian and the mirror image of it.
fn revolved(polygon: &[Vec2]) -> [f64; 2] {
    let next = polygon.iter().cycle().skip(1);
    let sides = polygon.iter().zip(next).map(|(a, b)| {
        let volume = (a.y * a.y + a.y * b.y + b.y * b.y) * (a.x - b.x) / 3.0;
        Vec2::new(volume * a.y.signum(), (a.y.abs() + b.y.abs()) * a.distance(*b))
    });
    let Vec2 { x, y } = 0.5 * std::f64::consts::PI * sides.sum::<Vec2>();
    [x.abs(), y]
}

/// Squeezed spheres keep their volume; the particles are spread over the larger surface.
#[test]
fn squeezed_spheres_have_the_volume_of_the_sphere() {
    let pi = std::f64::consts::PI;
    for to in [Squeezed::Ellipse, Squeezed::Stadium] {
        for (radius, half) in [(1.0, 0.8), (2.0, 1.1), (0.5, 0.49)] {
            let (curve, ratio) = droplet::squeezed_sphere(radius, half, to).unwrap();
            let polygon = curve.markers(4000).unwrap();
            let height = polygon.iter().map(|place| place.y).fold(0.0, f64::max);
            let [volume, area] = revolved(&polygon);
            assert!((height / half - 1.0).abs() < 1e-4, "{to:?} {half}: {height}");
            assert!((volume / (4.0 / 3.0 * pi * radius.powi(3)) - 1.0).abs() < 1e-4, "{to:?} {half}: {volume}");
            assert!((ratio * area / (4.0 * pi * radius * radius) - 1.0).abs() < 1e-4, "{to:?} {half}: {area} {ratio}");
        }
    }
}

#[test]
fn stripes_begin_where_they_should_and_repeat() {
    let factors = vec![1.0, 2.0, 5.0];
    let grading = Grading::Stripes { axis: Axis::X, width: 0.5, from: 0.25, factors };
    for (x, factor) in
        [(0.2, 5.0), (0.3, 1.0), (0.7, 1.0), (0.8, 2.0), (1.3, 5.0), (1.8, 1.0), (-0.2, 5.0), (-0.3, 2.0), (-1.2, 1.0)]
    {
        assert_eq!(grading.factor(Vec2::new(x, 7.0)), factor, "{x}");
    }
}

/// Walls that slide at half the shear rate times the width drive the shear that a channel refuses.
#[test]
fn a_shear_in_a_channel_is_refused_with_the_walls_that_drive_it() {
    let flow = FlowSetup { shear: 2.0, ..FlowSetup::default() };
    let said = refused(&Setup { region: channel(3.0), flow, ..Setup::default() });
    assert!(said.starts_with("flow.shear = 2") && said.contains("wall-velocity = [-3, 3]"), "{said}");
    let wall_velocity = Some([-3.0, 3.0]);
    let sliding = FlowSetup { wall_velocity, ..FlowSetup::default() }.imposed(&channel(3.0)).unwrap();
    assert_eq!(sliding, FlowSetup { shear: 2.0, ..FlowSetup::default() }.imposed(&Region::Plane).unwrap());
}

/// A wall may be thicker than half of the channel: the fluid is all the same between it and the other side.
#[test]
fn elastic_walls_through_points_may_reach_beyond_the_middle() {
    let flat = |y: f64| [-3.0, -1.5, 0.0, 1.5].map(|x| [x, y]).to_vec();
    let base = elastic(3.0, plain());
    for (outline, thickness) in [
        (SolidOutline::WallAbovePoints(flat(-0.5)), 3.0),
        (SolidOutline::WallAbovePoints(flat(0.5)), 2.0),
        (SolidOutline::WallBelowPoints(flat(0.5)), 3.0),
    ] {
        let solids = vec![SolidSetup { outline, ..base.solids[0].clone() }];
        let setup = Setup { droplets: Vec::new(), solids, ..base.clone() };
        let Built { scene, solids, .. } = setup.build().unwrap();
        let area = scene.body(solids[0]).unwrap().mesh().area();
        assert!((area - 6.0 * thickness).abs() < 1e-9, "{area} {thickness}");
    }
}

/// A droplet in a rigid wall is told how deep it reaches into it.
#[test]
fn overlaps_with_rigid_walls_have_their_depth() {
    let walls = WallSetup::channel(&ChannelShape::Straight { width: 3.0 }, 0.15);
    for side in [1.0, -1.0] {
        let shape = DropletShape::Ellipse { half_axes: [1.0; 2] };
        let droplets = vec![DropletSetup { centre: [0.0, 0.75 * side], shape, ..DropletSetup::default() }];
        let setup = Setup { region: channel(6.0), walls: walls.clone(), droplets, ..Setup::default() };
        let Err(crate::SetupError::Overlap { depth, y, .. }) = setup.build().map(|_| ()) else { panic!("no overlap") };
        assert!((depth - 0.25).abs() < 5e-3 && (side * y - 1.75).abs() < 5e-3, "{depth} {y}");
    }
}

/// A droplet fits into a tube up to both of its ends.
#[test]
fn droplets_fit_between_both_ends_of_a_tube() {
    let shape = motile_base::TubeShape::Constriction { throat: 1.2, throat_length: 2.0, ramp: 2.0 };
    let region = Region::Tube { radius: 1.5, shape, drive: Drive::ZeroFlux, length: Some(24.0) };
    let at = |x: f64| {
        let droplets = vec![DropletSetup { centre: [x, 0.0], ..DropletSetup::default() }];
        Setup { region, droplets, ..Setup::default() }.build().map(|_| ()).map_err(|error| error.to_string())
    };
    for side in [1.0, -1.0] {
        let error = at(11.5 * side).unwrap_err();
        assert!(error.starts_with("droplets[0]: the body does not fit into the region"), "{error}");
        assert_eq!(at(8.0 * side), Ok(()));
    }
}

/// A mode and a half for each of three markers, also of an odd number of nodes.
#[test]
fn membranes_have_three_markers_for_two_modes() {
    let count = |nodes: usize, elements: usize| {
        let setup = Setup { method: Method::Integral(IntegralMethod { nodes, elements }), ..Setup::default() };
        setup.membrane_count(&Curve::circle(1.0).unwrap(), "the shell").unwrap()
    };
    for (nodes, least) in [(32, 48), (33, 50), (64, 96), (65, 98)] {
        assert_eq!(count(nodes, nodes), least);
        assert_eq!(count(nodes, 200), 200);
    }
}

/// A place has one factor.
#[test]
fn places_of_a_grading_increase() {
    let wall = elastic(3.0, plain());
    let of = |factors: Vec<[f64; 2]>| {
        let grading = Grading::Along { axis: Axis::X, factors };
        let solids = vec![SolidSetup { grading, ..wall.solids[0].clone() }];
        Setup { solids, ..wall.clone() }.check().map_err(|error| error.to_string())
    };
    assert_eq!(of(vec![[0.0, 1.0], [0.5, 2.0]]), Ok(()));
    let error = of(vec![[0.0, 1.0], [0.5, 2.0], [0.5, 3.0]]).unwrap_err();
    assert!(error.starts_with("solids[0].grading.along.factors") && error.contains("in increasing order"), "{error}");
}

#[test]
fn obstacles_that_touch_or_cross_the_straight_walls_are_refused() {
    let region = Region::Channel { length: 8.0, width: 6.0, drive: Drive::ZeroGradient };
    let built = |y: f64| {
        let outline = SolidOutline::Disc { centre: [2.0, y], radius: 0.5 };
        let walls = vec![WallSetup::new(outline, 0.1)];
        Setup { region, walls, ..Setup::default() }.build().map(drop)
    };
    assert!(built(2.4).is_ok());
    for y in [2.5, 2.6, 9.0, -2.5] {
        let error = built(y).unwrap_err().to_string();
        assert!(
            error.starts_with("walls[0].outline = ") && error.contains("straight walls at y = -3.000e0"),
            "{error}"
        );
    }
}

/// The wall that crosses itself is named, not the droplet that has no room next to it.
#[test]
fn walls_that_cross_themselves_are_named() {
    let bow = vec![[1.8, -0.4], [2.6, 0.4], [2.6, -0.4], [1.8, 0.4]];
    let bow = WallSetup::new(SolidOutline::Polygon { corners: bow, rounding: 0.0 }, 0.05);
    let disc = WallSetup::new(SolidOutline::Disc { centre: [-2.5, 0.0], radius: 0.3 }, 0.05);
    let setup = Setup { region: channel(6.0), walls: vec![disc.clone(), bow], ..Setup::default() };
    let error = refused(&setup);
    // The edges cross at (2.2, 0), and the curve has nodes 0.05 apart.
    let near = error.strip_prefix("walls[1]: the outline crosses itself near (").and_then(|rest| rest.split_once(')'));
    let place: Vec<f64> = near.expect("a place").0.split(", ").map(|x| x.parse().unwrap()).collect();
    assert!((place[0] - 2.2).abs() < 0.05 && place[1].abs() < 0.05, "{error}");
    let setup = Setup { walls: vec![disc], ..Setup::default() };
    assert!(refused(&setup).starts_with("walls[0]: rigid walls need region.channel; this region is a box. Use region"));
}

#[test]
fn warnings_have_the_number_of_their_droplet() {
    let method = Method::Integral(IntegralMethod { nodes: 16, elements: 64 });
    let droplet = |x: f64| DropletSetup { centre: [x, 0.0], ..DropletSetup::active(-2.0) };
    let region = Region::Box { lengths: [8.0, 6.0] };
    let setup = Setup { region, method, droplets: vec![droplet(-2.0), droplet(2.0)], ..Setup::default() };
    let warnings = setup.build().unwrap().scene.system_mut().warnings();
    let few = warnings.iter().filter(|warning| warning.cause == "shape not resolved");
    let bodies: Vec<&str> = few.map(|warning| warning.body.as_str()).collect();
    assert_eq!(bodies, ["droplet (body 0)", "droplet (body 1)"]);
}

/// Nothing stops the particles of these droplets: they are refused before a run, from Rust as from scene files.
#[test]
fn droplets_that_would_collapse_are_refused() {
    let of = |droplet: DropletSetup| Setup { droplets: vec![droplet], ..Setup::default() };
    assert_eq!(
        refused(&of(DropletSetup::active(-12.0))),
        "droplets[0].particles.activity = -12: the excluded volume is only 10, so the particles would collapse to a \
         point. Use an activity weaker than -10, or a larger excluded volume"
    );
    assert!(of(DropletSetup::contractile(-12.0, 13.0)).build().is_ok());
    assert!(of(DropletSetup::active(-9.9)).build().is_ok());
    // Ten times as viscous, they swim only a little above the threshold, and runs of some length succeed.
    assert!(Setup { viscosity: 1000.0, ..of(DropletSetup::active(-12.0)) }.build().is_ok());
    // Droplets of a suspension are known when they are placed.
    let region = Region::Box { lengths: [12.0, 12.0] };
    let activity = Some(Distribution::Value(-12.0));
    let suspension = vec![SuspensionSetup { count: Some(2), activity, ..SuspensionSetup::default() }];
    let error = refused(&Setup { region, droplets: Vec::new(), suspension, ..Setup::default() });
    assert!(error.starts_with("suspension.activity = -12: the excluded volume is only 10"), "{error}");
}

#[test]
fn angles_in_degrees_get_a_hint() {
    let at =
        |angle: f64| Setup { droplets: vec![DropletSetup { angle, ..DropletSetup::active(-2.0) }], ..Setup::default() };
    assert_eq!(at(90.0).hints(), ["droplets[0].angle = 90: angles are in radians. If you mean degrees, use 1.5708"]);
    assert!(at(-6.2).hints().is_empty());
}

/// Radii far from 1 beside the defaults, which are for lengths in radii.
#[test]
fn radii_in_other_units_than_the_defaults_get_a_hint() {
    let hints = |radius: f64| {
        let droplet = DropletSetup::active(-2.0).with_radius(radius);
        Setup { region: Region::Plane, droplets: vec![droplet], ..Setup::default() }.hints()
    };
    for radius in [1e-6, 1e-3, 5.0, 100.0] {
        let hint = &hints(radius)[0];
        assert!(
            hint.starts_with(&format!("droplets[0]: a radius of {radius} and the defaults viscosity 100 (")),
            "{hint}"
        );
    }
    assert!(hints(0.3).is_empty() && hints(3.0).is_empty());
    let small = DropletSetup { centre: [3.0, 0.0], ..DropletSetup::active(-2.0).with_radius(0.1) };
    let droplets = vec![small, DropletSetup::active(-2.0)];
    assert!(Setup { region: Region::Plane, droplets, ..Setup::default() }.hints().is_empty());
}

#[test]
fn positive_activities_get_a_hint() {
    let droplets = vec![DropletSetup::active(-2.0), DropletSetup { centre: [3.0, 0.0], ..DropletSetup::active(2.0) }];
    let setup = Setup { region: Region::Box { lengths: [12.0, 6.0] }, droplets, ..Setup::default() };
    assert!(setup.check().is_ok());
    let hints = setup.hints();
    assert_eq!(hints.len(), 1);
    assert!(hints[0].starts_with("droplets[1].particles.activity = 2: "), "{hints:?}");
}
