use std::f64::consts::TAU;

use stokes_grid::{ChannelStokes, Grid};

use super::*;
use crate::{CubicQuadratic, MarkerKind, hydrodynamics::SurfaceCurve};

const H: f64 = 0.1;
const NODES: usize = 72;

fn circle(centre: Vec2, radius: f64, count: usize) -> Vec<Vec2> {
    let at = |k: usize| centre + radius * Vec2::from_angle(TAU * k as f64 / count as f64);
    (0..count).map(at).collect()
}

/// A droplet at the origin and a disc of radius 0.7 beside it, whose inner points are `lattice` apart.
fn droplet_and_disc(gap: f64, count: usize, lattice: f64) -> Markers {
    let centre = Vec2::new(0.3, 1.7 + gap);
    let disc = circle(centre, 0.7, count);
    let rows = (0.7 / lattice) as i32;
    let places = (-rows..=rows).flat_map(|i| (-rows..=rows).map(move |j| Vec2::new(f64::from(i), f64::from(j)) * lattice));
    let inner: Vec<Vec2> = places.filter(|x| x.length() < 0.7 - 0.8 * lattice).map(|x| x + centre).collect();
    let mut markers = Markers::new();
    let droplet = circle(Vec2::ZERO, 1.0, NODES);
    markers.push_group(droplet.len(), MarkerKind::Interface { viscosity_inside: None });
    let surface = SurfaceCurve { markers: (0..count).map(|k| (k, 0)).collect(), periods: 0 };
    markers.push_solid(count + inner.len(), MarkerKind::Points, vec![surface]);
    markers.positions = [droplet, disc, inner].concat();
    markers
}

/// A droplet between straight walls of lattices, whose surfaces have points half as far apart.
fn droplet_and_walls(gap: f64, length: f64, lattice: f64) -> Markers {
    let mut markers = Markers::new();
    let droplet = circle(Vec2::ZERO, 1.0, NODES);
    markers.push_group(droplet.len(), MarkerKind::Interface { viscosity_inside: None });
    let mut positions = droplet;
    let columns = (length / lattice).round() as usize;
    for side in [-1.0, 1.0] {
        let mut points = Vec::new();
        let count = 2 * columns;
        points.extend((0..count).map(|k| Vec2::new(0.5 * lattice * k as f64, side * (1.0 + gap))));
        for row in 1..6 {
            let y = 1.0 + gap + 0.866 * lattice * f64::from(row);
            let shift = 0.5 * f64::from(row % 2);
            points.extend((0..columns).map(|k| Vec2::new(lattice * (k as f64 + shift), side * y)));
        }
        let surface = SurfaceCurve { markers: (0..count).map(|k| (k, 0)).collect(), periods: 1 };
        markers.push_solid(points.len(), MarkerKind::Points, vec![surface]);
        positions.extend(points);
    }
    markers.positions = positions;
    markers
}

/// The mobility, column by column.
fn mobility(flow: &mut impl Hydrodynamics, markers: &mut Markers) -> Vec<Vec<f64>> {
    (0..2 * markers.len())
        .map(|column| {
            markers.forces.fill(Vec2::ZERO);
            markers.forces[column / 2][column % 2] = 1.0;
            flow.velocities(markers).unwrap();
            markers.velocities.iter().flat_map(|v| v.to_array()).collect()
        })
        .collect()
}

#[test]
fn dump() {
    let write = |name: String, mut markers: Markers| {
        let solver = ChannelStokes::new(Grid::channel(60, 60, H).unwrap(), 1.0).unwrap();
        let settings = Settings { nodes: NODES, ..Settings::default() };
        let mut flow = ImmersedLayers::new(solver, CubicQuadratic::default(), settings).unwrap();
        let matrix = mobility(&mut flow, &mut markers);
        let text: Vec<String> = matrix
            .iter()
            .map(|row| row.iter().map(|x| format!("{x:e}")).collect::<Vec<_>>().join(" "))
            .collect();
        std::fs::write(format!("/tmp/w/H-out/{name}.txt"), text.join("\n")).unwrap();
    };
    for (gap, lattice) in [(0.3, 0.2), (0.1, 0.2), (0.05, 0.2), (0.05, 0.1)] {
        write(format!("m_{gap}_{lattice}"), droplet_and_disc(gap, if lattice > 0.15 { 44 } else { 88 }, lattice));
        write(format!("w_{gap}_{lattice}"), droplet_and_walls(gap, 6.0, lattice));
    }
}

#[test]
fn timing() {
    let solver = ChannelStokes::new(Grid::channel(120, 50, H).unwrap(), 1.0).unwrap();
    for tolerance in [1e-8, 1e-6, 1e-4] {
        let settings = Settings { nodes: 72, tolerance, ..Settings::default() };
        let mut flow = ImmersedLayers::new(solver.clone(), CubicQuadratic::default(), settings).unwrap();
        let mut markers = droplet_and_walls(0.07, 12.0, 0.2);
        markers.forces.fill(Vec2::new(1.0, 0.3));
        flow.velocities(&mut markers).unwrap();
        let n = 50;
        let mut times = [0.0; 6];
        for _ in 0..n {
            let mut t = std::time::Instant::now();
            let mut lap = |k: usize| {
                times[k] += t.elapsed().as_secs_f64() * 1e3 / f64::from(n);
                t = std::time::Instant::now();
            };
            flow.load(&markers).unwrap();
            lap(0);
            flow.layer.load(flow.curves.layers()).unwrap();
            lap(1);
            flow.layer.apply(&flow.curves.forces, &mut flow.curves.velocities).unwrap();
            lap(2);
            flow.solve_inner(&markers).unwrap();
            flow.nodes.interpolate(&flow.velocity, &mut flow.curves.grid[2]).unwrap();
            lap(3);
            flow.curves.write(1.0, &mut markers.velocities).unwrap();
            lap(4);
            flow.solve_all().unwrap();
            flow.inner.interpolate(&flow.velocity, &mut flow.values).unwrap();
            lap(5);
        }
        println!("{tolerance:e} {} {times:?}", markers.len());
    }
}
