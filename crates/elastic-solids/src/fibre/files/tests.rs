use super::*;

/// A quarter of a circle of radius 1 with five nodes, as IBAMR's files have it: counted from 0, not in order.
fn arc() -> [String; 4] {
    let order = [2, 0, 1, 3, 4];
    let mut places = [Vec2::ZERO; 5];
    for (k, node) in order.into_iter().enumerate() {
        places[node] = Vec2::from_angle(0.1 * k as f64);
    }
    let vertices: Vec<String> = places.iter().map(|place| format!("{} {}", place.x, place.y)).collect();
    let springs: Vec<String> = order.windows(2).map(|pair| format!("{} {} 50.0 0.1", pair[0], pair[1])).collect();
    let beams: Vec<String> =
        order.windows(3).map(|nodes| format!("{} {} {} 2000.0", nodes[0], nodes[1], nodes[2])).collect();
    let file = |rows: &[String]| format!("{} # rows\n{}\n", rows.len(), rows.join("\n"));
    [file(&vertices), file(&springs), file(&beams), "1\n2 7.0\n".to_owned()]
}

fn parsed(texts: &[String; 4]) -> Result<Fibre, SolidError> {
    FibreFiles::parse([&texts[0], &texts[1], &texts[2], &texts[3]])?.fibre()
}

/// Energies of the formulas of the files themselves.
#[test]
fn a_chain_has_the_energy_of_its_springs_and_beams() {
    let fibre = parsed(&arc()).unwrap();
    let nodes: Vec<Vec2> = (0..5).map(|k| Vec2::from_angle(0.1 * f64::from(k))).collect();
    assert_eq!(fibre.nodes(), nodes);
    assert_eq!(fibre.targets(), [Target::fixed(0, Vec2::X, 7.0)]);
    let bent = fibre.deformed(&nodes.iter().map(|x| *x + Vec2::new(0.002 * x.y, 0.0)).collect::<Vec<_>>()).unwrap();
    let places = bent.nodes();
    let stretching: f64 = places.windows(2).map(|p| 25.0 * (p[0].distance(p[1]) - 0.1).powi(2)).sum();
    let bending: f64 = places.windows(3).map(|p| 1000.0 * (p[0] - 2.0 * p[1] + p[2]).length_squared()).sum();
    let [found, curved, held] = bent.energies();
    assert!((found / stretching - 1.0).abs() < 1e-9, "{found} {stretching}");
    // Small turns of 0.1.
    assert!((curved / bending - 1.0).abs() < 0.01, "{curved} {bending}");
    assert!(held == 0.0, "{held}");
}

#[test]
fn curvatures_at_rest_have_the_sign_of_the_program() {
    let [vertices, springs, _, targets] = arc();
    let nodes = [2, 0, 1, 3, 4];
    let turn = 0.1_f64;
    let chord = 2.0 * (0.5 * turn).sin();
    // IB2d: (xr - xq)(yq - yp) - (yr - yq)(xq - xp), of a turn to the left negative; IBAMR: the second difference.
    let product = -chord * chord * turn.sin();
    let laws: [&dyn Fn(usize) -> String; 2] = [&|_| format!("9.0 {product}"), &|k| {
        let at = |k: usize| Vec2::from_angle(0.1 * k as f64);
        let second = at(k) - 2.0 * at(k + 1) + at(k + 2);
        format!("9.0 {} {}", second.x, second.y)
    }];
    for law in laws {
        for reversed in [false, true] {
            let rows = nodes.windows(3).enumerate().map(|(k, n)| {
                let [a, c] = if reversed { [n[2], n[0]] } else { [n[0], n[2]] };
                let law = law(k);
                // The product changes its sign with the direction.
                let law = if reversed && law.matches(' ').count() == 1 { law.replace('-', "") } else { law };
                format!("{a} {} {c} {law}\n", n[1])
            });
            let beams = format!("3\n{}", rows.collect::<String>());
            let rest = springs.replace(" 0.1", &format!(" {chord}"));
            let fibre = parsed(&[vertices.clone(), rest, beams, targets.clone()]).unwrap();
            let straight = fibre.clone().with_reference_curvature(0.0).unwrap().energies()[1];
            assert!(fibre.energies()[1] < 1e-3 * straight, "{:?} {straight}", fibre.energies());
        }
    }
}

#[test]
fn a_ring_of_ib2d_counts_from_one() {
    let vertices = "4\n1 0\n0 1\n-1 0\n0 -1\n".to_owned();
    let springs = "4\n1 2 3.0 1.0\n2 3 3.0 1.0\n3 4 3.0 1.0\n4 1 3.0 1.0\n".to_owned();
    let ring = parsed(&[vertices, springs, String::new(), "1\n2 5.0\n".to_owned()]).unwrap();
    assert_eq!(ring.targets(), [Target::fixed(1, Vec2::Y, 5.0)]);
    assert_eq!(ring.period(), Some(Vec2::ZERO));
    let exact = 4.0 * 1.5 * (2.0_f64.sqrt() - 1.0).powi(2);
    assert!((ring.energies()[0] / exact - 1.0).abs() < 1e-12, "{:?}", ring.energies());
}

#[test]
fn what_is_no_chain_is_refused_with_its_line() {
    let [vertices, springs, beams, targets] = arc();
    let says = |texts: [String; 4], words: &str| {
        let text = parsed(&texts).unwrap_err().to_string();
        assert!(text.contains(words), "{text}");
    };
    let with = |k: usize, text: &str| {
        let mut all = [vertices.clone(), springs.clone(), beams.clone(), targets.clone()];
        all[k] = text.to_owned();
        all
    };
    says(with(0, "2\n0 0\n1 x\n"), "line 3 of the vertex file cannot be used: \"x\" is not a number");
    says(with(0, "2.5\n0 0\n"), "line 1 of the vertex file");
    says(with(0, "3\n0 0\n"), "the vertex file ends too early");
    says(with(0, "1\n0 0\n1 1\n"), "line 3 of the vertex file");
    says(with(1, "1\n0 9 1.0 1.0\n"), "node 9 does not exist");
    says(with(1, "1\n0 1 -1.0 1.0\n"), "the stiffness -1 is negative");
    says(with(1, "2\n0 1 1 1\n2 3 1 1\n"), "do not form one chain");
    says(with(2, "1\n0 1 4 1.0\n"), "leaves the chain");
    says(with(2, "1\n0 1 1.0\n"), "it has 3 numbers");
    says(with(3, "1\n0.5 1.0\n"), "node 0.5 does not exist");
    let read = FibreFiles::read(Path::new("no-such-folder/beam")).unwrap_err().to_string();
    assert!(read.contains("no-such-folder/beam.spring cannot be read"), "{read}");
}
