//! Checks of scenes: what would run, without running it.

use std::error::Error;
use std::io::IsTerminal as _;
use std::time::Instant;

use anyhow::Result;
use motile::base::internal::told;
use motile::scene::{Every, SceneError, StepSize, System, Warnings};
use motile::setup::{AnyFlow, Built, DropletSetup, DropletShape, MeshGroup, Numbers, Setup, SolidOutline};
use motile::space_droplets::SpaceDroplet;
use motile_cli::keys::written_out;
use motile_cli::run::{Decided, Summary, say};
use toml::Value;

/// Steps that are tried.
const TRIED: usize = 10;
/// Most bodies that are listed.
const MOST_BODIES: usize = 20;

/// Builds a scene, takes its first steps, and prints what a run to the time `end` would be: region, method, bodies with
/// their sizes and dimensionless numbers, steps, cost, and the warnings of
/// the start and the first steps. Writes no files.
///
/// # Errors
/// Returns an error for a scene that cannot be built, or whose first steps fail.
pub(crate) fn check(setup: &Setup, end: f64) -> Result<()> {
    let Built { mut scene, space, .. } = setup.build()?;
    let placed = setup.placed()?;
    let mut report = Summary::default();
    let entries = written_out(setup)?;
    for key in ["region", "method", "step"] {
        report.put(key, entries.get(key).map_or(String::new(), Value::to_string), "");
    }
    if let Some(body) = space {
        let droplets = scene.body(body)?.droplets().droplets();
        let degree = droplets.first().map(SpaceDroplet::degree);
        report.put("degree", degree, &format!("of the spherical harmonics of all {} droplets", droplets.len()));
        for (number, droplet) in placed.droplets.iter().enumerate().take(MOST_BODIES) {
            let about = format!("radius {:.4}{}", droplet.shape.radius()?, numbers_of(&placed, droplet)?);
            report.put(&format!("droplet {number}"), droplet.name.as_str(), &about);
        }
    } else {
        let markers: usize = scene.system().all_bodies().map(|(_, body)| body.marker_count()).sum();
        report.put("markers", markers, &format!("of all {} bodies", scene.system().all_bodies().len()));
    }
    // In the order in which bodies are added.
    let shapes = placed.droplets.iter().map(|body| Some(&body.shape)).chain(placed.solids.iter().map(|_| None));
    let shapes = shapes.chain(placed.rigid_bodies.iter().map(|body| Some(&body.shape)));
    let shapes: Vec<Option<&DropletShape>> = shapes.chain(placed.shells.iter().map(|body| Some(&body.shape))).collect();
    let listed = if space.is_some() { 0 } else { MOST_BODIES };
    for (handle, body) in scene.system().all_bodies().take(listed) {
        let mut about = format!("{} markers", body.marker_count());
        if let Some(Some(shape)) = shapes.get(handle.index()) {
            about += &format!(", radius {:.4}", shape.radius()?);
        }
        if let Some(droplet) = placed.droplets.get(handle.index()) {
            about += &numbers_of(&placed, droplet)?;
        }
        report.put(&format!("body {}", handle.index()), body.name(), &about);
    }
    report.put("length_scale", placed.length_scale(), "that times and pictures refer to (length)");
    if let Some(filled) = setup.filled()? {
        report.put("area_fraction", filled, "of the droplets of suspensions");
    }
    for (key, distance) in setup.distances_from_points()? {
        report.put(&key, distance, "largest distance of the shape from the polygon through its points (length)");
    }
    for outline in setup.outlines()? {
        let direction = if outline.was_clockwise { ", given clockwise" } else { "" };
        let repeated = if outline.repeated > 0 { format!(", {} repeated", outline.repeated) } else { String::new() };
        report.put(&format!("{}.points", outline.key), outline.points, &format!("used{repeated}{direction}"));
        let areas =
            [("area", outline.area, outline.polygon_area), ("perimeter", outline.perimeter, outline.polygon_perimeter)];
        for (name, shape, polygon) in areas {
            let percent = 100.0 * (shape / polygon - 1.0);
            let about = format!("of the shape; {} of the polygon through the points ({percent:+.3} %)", told(polygon));
            report.put(&format!("{}.{name}", outline.key), shape, &about);
        }
    }
    for (number, solid) in placed.solids.iter().enumerate() {
        if let SolidOutline::Mesh(mesh) = &solid.outline {
            let names = |groups: &[MeshGroup]| {
                let names: Vec<String> = groups.iter().map(|group| format!("{:?}", group.name)).collect();
                if names.is_empty() { "none".to_owned() } else { names.join(", ") }
            };
            let [groups, lines] = [&mesh.groups, &mesh.boundaries].map(|groups| names(groups));
            let about = format!("{} points; groups of triangles: {groups}; of lines: {lines}", mesh.points.len());
            let key = format!("solids[{number}].outline.mesh");
            report.put(&format!("{key}.triangles"), mesh.triangles.len(), &about);
            let place = |corner: usize| mesh.points.get(corner).map_or([f64::NAN; 2], |point| *point);
            let area: f64 = mesh.triangles.iter().map(|corners| area(corners.map(place))).sum();
            let [x, y] = [0, 1].map(|axis| {
                let sides = mesh.points.iter().map(|point| point[axis]);
                sides.clone().fold(f64::NEG_INFINITY, f64::max) - sides.fold(f64::INFINITY, f64::min)
            });
            let about = format!("of all triangles; {} long and {} high", told(mesh.scale * x), told(mesh.scale * y));
            report.put(&format!("{key}.area"), mesh.scale * mesh.scale * area, &about);
        }
    }
    let mut gap = scene.system().minimum_gap();
    if let Some(body) = space {
        let droplets = scene.body(body)?.droplets();
        let gaps = (0..droplets.droplets().len()).map(|number| droplets.smallest_gap(number));
        gap = gaps.collect::<Result<Vec<_>, _>>()?.into_iter().flatten().reduce(f64::min);
    }
    report.put("minimum_gap", gap, "between bodies and to walls (length)");
    if let Some(error) = setup.expected_error() {
        report.put(
            "expected_error",
            error,
            "largest relative error of the speed that was measured with these settings",
        );
    }
    // Narrow gaps in three dimensions take minutes.
    if std::io::stderr().is_terminal() {
        eprintln!("trying the first {TRIED} steps ...");
    }
    scene.system_mut().evaluate()?;
    let mut warnings = Warnings::default();
    warnings.look(scene.system_mut());

    // The first steps.
    if let StepSize::Fixed(dt) = setup.step {
        scene.check_step(dt)?;
    }
    if let Some((limit, reason, body)) = scene.step_limit() {
        report.put("step_limit", limit, &format!("at the start (time), set by {reason} of {body}"));
    }
    let started = Instant::now();
    let mut few = |system: &mut System<AnyFlow>| {
        system.evaluate()?;
        warnings.look(system);
        if system.steps() < TRIED { Ok::<_, Box<dyn Error + Send + Sync>>(()) } else { Err(Decided.into()) }
    };
    match scene.run(end).observe(Every::Steps(1), &mut few).go() {
        Err(SceneError::Observer { source, .. }) if source.is::<Decided>() => {}
        outcome => outcome?,
    }
    let (tried, longest) = (scene.steps() as f64, scene.step_report().longest);
    let seconds = started.elapsed().as_secs_f64() / tried;
    report.put("steps", (end / longest).ceil(), &format!("to t = {end}, if all were as long as the first ones"));
    report.put("seconds", seconds * end / longest, "for them on this machine, without pictures");
    say(report.table().trim_end());
    for hint in setup.hints() {
        say(format_args!("note: {hint}"));
    }
    for (_, warning) in warnings.worst() {
        say(format_args!("warning: {warning}"));
    }
    Ok(())
}

/// Returns the area of a triangle (length squared).
fn area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
}

/// Returns the dimensionless numbers of a droplet as text after a comma; empty without activity.
fn numbers_of(placed: &Setup, droplet: &DropletSetup) -> Result<String> {
    let Some(Numbers { peclet, bare_tension, viscosity_ratio, excluded_volume }) = placed.numbers(droplet)? else {
        return Ok(String::new());
    };
    let volume = excluded_volume.map_or(String::new(), |ratio| format!(", A/|ζΔμ| {ratio:.4}"));
    let first = format!(", Péclet number {peclet:.4}{volume}, γ0/(|ζΔμ| c0) {bare_tension:.4}");
    Ok(format!("{first}, ηin/ηext {viscosity_ratio:.4}"))
}
