use super::*;
use crate::DiscMesh;

/// Speeds that fluid at rest at the interface turns about with.
const SPEEDS: [f64; 3] = [0.03, 1.0, 40.0];

/// Without diffusion densities change in proportion to the speed, by no more than the limiter leaves room for beside
/// upwind fluxes, and have no new extremes: a node below its neighbours does not fall, one above them does not rise.
#[test]
fn transport_is_limited_in_proportion_to_the_speed() {
    let mut mesh = DiscMesh::new(48, 0.15).unwrap();
    let mut nodes = vec![Vec2::ZERO; mesh.node_count()];
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / 48.0;
    nodes.iter_mut().take(48).enumerate().for_each(|(k, node)| *node = Vec2::from_angle(angle(k)));
    mesh.place(&mut nodes);
    let cells = Cells::new(mesh.triangles().to_vec(), &nodes);
    let densities: Vec<f64> = (0..nodes.len()).map(|k| 1.0 + 0.9 * (12.9898 * k as f64).sin()).collect();
    let numbers: Vec<f64> = densities.iter().zip(&cells.areas).map(|(density, area)| density * area).collect();
    let mut transport = Transport::new(&cells, &nodes).unwrap();
    let rates = SPEEDS.map(|speed| {
        // What of it does not keep the areas of cells is taken out.
        let velocity = |at: &Vec2| speed * (1.0 - at.length_squared()) * Vec2::new(1.0 - at.y, 2.0 * at.x);
        let fluid: Vec<Vec2> = nodes.iter().map(velocity).collect();
        transport.set_motion(&cells, &nodes, (&fluid, &vec![Vec2::ZERO; nodes.len()]));
        let mut rate = vec![0.0; nodes.len()];
        transport.add(&cells, &numbers, 0.0, &mut rate);
        // What is added to upwind fluxes, and the room for it.
        let (mut added, mut room) = (rate.clone(), vec![[0.0_f64; 2]; nodes.len()]);
        let mut sums = vec![0.0; nodes.len()];
        for (&[i, j], flux) in cells.edges.iter().zip(&transport.fluxes) {
            let carried = flux.max(0.0) * densities[i] + flux.min(0.0) * densities[j];
            added[i] += carried;
            added[j] -= carried;
            for (node, rise) in [(i, densities[j] - densities[i]), (j, densities[i] - densities[j])] {
                sums[node] += 0.5 * flux.abs();
                let [least, most] = &mut room[node];
                (*least, *most) = (least.min(rise), most.max(rise));
            }
        }
        let mut extremes = [0; 2];
        for (k, (added, [least, most])) in added.iter().zip(&room).enumerate() {
            let [least, most] = [least, most].map(|rise| ROOM * sums[k] * rise);
            assert!((least - 1e-12 * speed..=most + 1e-12 * speed).contains(added), "{k}: {added} {least} {most}");
            let change = rate[k] / speed;
            extremes[0] += usize::from(least == 0.0);
            extremes[1] += usize::from(most == 0.0);
            assert!((least < 0.0 || change > -1e-9) && (most > 0.0 || change < 1e-9), "{k}: {change}");
        }
        assert!(extremes.iter().all(|count| *count > 5), "{extremes:?}");
        rate
    });
    let largest = rates[1].iter().fold(0.0_f64, |largest, rate| largest.max(rate.abs()));
    for (speed, rate) in SPEEDS.iter().zip(&rates) {
        let apart = rate.iter().zip(&rates[1]).map(|(rate, one)| (rate / speed - one).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-9 * largest, "{speed}: {apart} of {largest}");
    }
}

/// Nothing crosses the faces of cells in fluid that moves with them, also where all of them grow or shrink.
#[test]
fn a_mesh_that_moves_with_the_fluid_carries_its_particles_along() {
    let mut mesh = DiscMesh::new(48, 0.15).unwrap();
    let mut nodes = vec![Vec2::ZERO; mesh.node_count()];
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / 48.0;
    nodes.iter_mut().take(48).enumerate().for_each(|(k, node)| *node = Vec2::from_angle(angle(k)));
    mesh.place(&mut nodes);
    let cells = Cells::new(mesh.triangles().to_vec(), &nodes);
    let mut transport = Transport::new(&cells, &nodes).unwrap();
    for growth in [0.0, 0.3, -0.2] {
        let velocity = |at: &Vec2| Vec2::new(0.4, -0.1) + growth * *at + 0.7 * at.perp();
        let motion: Vec<Vec2> = nodes.iter().map(velocity).collect();
        transport.set_motion(&cells, &nodes, (&motion, &motion));
        let largest = transport.fluxes.iter().fold(0.0_f64, |most, flux| most.max(flux.abs()));
        assert!(largest < 1e-13, "{growth}: {largest:e}");
    }
}
