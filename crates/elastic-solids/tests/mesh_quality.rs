//! How even the meshes of the ready shapes are.

use elastic_solids::{
    BranchingChannel, Channel, Constriction, MeshQuality, Mesher, Ratchet, SinusoidalChannel, TriangleMesh, Valve,
};

const PERIOD: f64 = 12.0;
const WIDTH: f64 = 2.0;

/// Quality of the lower wall and of the islands.
fn meshed(name: &str, shape: &Channel, spacing: f64, half: f64) -> (MeshQuality, Vec<MeshQuality>) {
    let walls = shape.walls(-half, half, &Mesher::new(spacing).expect("a spacing")).expect("walls");
    let islands: Vec<MeshQuality> = walls.islands.iter().map(TriangleMesh::quality).collect();
    let lower = walls.lower.quality();
    println!("{name}, spacing {spacing}: {lower}");
    islands.iter().for_each(|island| println!("    island: {island}"));
    (lower, islands)
}

/// Edge lengths deviate by 3 per cent and angles are 33 degrees or more; where the surface of a wall 15 to 20 spacings
/// thick rises slowly all along, as in the ratchet, every row that ends there costs a dislocation, and at the coarser
/// spacing the deviation stays a little higher.
#[test]
fn walls_are_even() {
    let (period, width) = (PERIOD, WIDTH);
    let constriction = Constriction::thesis().channel().unwrap();
    let ratchet = Ratchet { period, width, throat: 1.3, teeth: 3, rise: 0.7, sharp: false }.channel().unwrap();
    let sine = SinusoidalChannel { period, width, amplitude: 0.3, waves: 2, phase: 0.0 }.channel().unwrap();
    let valve = Valve { period, width, gap: 1.0, base: 1.0, radius: 0.2, centre: 0.0 }.channel().unwrap();
    let shapes = [
        ("constriction", constriction, [0.03, 0.03]),
        ("ratchet", ratchet, [0.037, 0.03]),
        ("sine", sine, [0.039, 0.03]),
        ("valve", valve, [0.03, 0.03]),
    ];
    for (name, shape, bounds) in shapes {
        for (spacing, bound) in [0.1, 0.05].into_iter().zip(bounds) {
            let (wall, _) = meshed(name, &shape, spacing, 2.5);
            assert!(wall.edge_deviation < bound, "{name}: {wall}");
            assert!(wall.smallest_angle > 33.0 && wall.uneven_edges < 0.01, "{name}: {wall}");
        }
    }
}

/// The walls of a branch likewise. Its island is 10 to 20 spacings thick and rounded at its ends, where no lattice fits.
#[test]
fn a_branch_and_its_island_are_even() {
    let (branches, island_length) = ([1.6, 1.6], 5.0);
    let branch =
        BranchingChannel { period: PERIOD, width: WIDTH, branches, island_length, island_thickness: 1.0, ramp: 1.5 };
    for (spacing, bound) in [(0.1, 0.055), (0.05, 0.045)] {
        let (wall, islands) = meshed("branch", &branch.channel().unwrap(), spacing, 4.0);
        assert!(wall.edge_deviation < 0.03 && wall.smallest_angle > 33.0, "{wall}");
        assert!(islands[0].edge_deviation < bound && islands[0].smallest_angle > 33.0, "{}", islands[0]);
    }
}
