//! Files for ParaView.

use std::collections::HashMap;

use motile::base::Vec2;
use motile::elastic_solids::{ChannelShape, Solid};
use motile::prelude::*;
use motile::scene::Observer;
use motile::setup::{Material, SolidSetup};
use motile_output::{ParaView, Raster, Snapshot, VtkFile, VtkSeries};
use roxmltree::{Document, Node};

use crate::{Directory, near};

/// Bytes of base64 (RFC 4648).
fn decoded(text: &str) -> Vec<u8> {
    let value = |c: u8| match c {
        b'A'..=b'Z' => c - b'A',
        b'a'..=b'z' => c - b'a' + 26,
        b'0'..=b'9' => c - b'0' + 52,
        b'+' => 62,
        b'/' => 63,
        other => panic!("{other} is no digit of base64"),
    };
    let digits: Vec<u8> = text.bytes().filter(|&c| c != b'=').map(value).collect();
    let group = |four: &[u8]| {
        let bits = (0..4).fold(0, |bits, k| (bits << 6) | u32::from(four.get(k).copied().unwrap_or(0)));
        bits.to_be_bytes()[1..four.len()].to_vec()
    };
    assert!(text.len().is_multiple_of(4));
    digits.chunks(4).flat_map(group).collect()
}

/// Values of a data array.
fn values(array: Node<'_, '_>) -> Vec<f64> {
    let bytes = decoded(array.text().expect("values").trim());
    let (size, bytes) = bytes.split_at(8);
    assert_eq!(u64::from_le_bytes(size.try_into().expect("eight")), bytes.len() as u64);
    let kind = array.attribute("type").expect("a type");
    let width = kind.trim_start_matches(|c: char| !c.is_ascii_digit()).parse::<usize>().expect(kind) / 8;
    let value = |b: &[u8]| match kind {
        "Float32" => f64::from(f32::from_le_bytes(b.try_into().expect("four"))),
        "Float64" => f64::from_le_bytes(b.try_into().expect("eight")),
        "Int64" => i64::from_le_bytes(b.try_into().expect("eight")) as f64,
        "UInt8" => f64::from(b[0]),
        other => panic!("{other} is not read here"),
    };
    bytes.chunks(width).map(value).collect()
}

/// Arrays of a file by the names of their sections and their own.
fn arrays(text: &str) -> HashMap<String, Vec<f64>> {
    let document = Document::parse(text).expect("XML");
    let root = document.root_element();
    assert_eq!([root.attribute("byte_order"), root.attribute("header_type")], [Some("LittleEndian"), Some("UInt64")]);
    let found = document.descendants().filter(|node| node.has_tag_name("DataArray"));
    let name = |node: Node<'_, '_>| {
        let section = node.parent().expect("a section").tag_name().name().to_owned();
        let components: usize = node.attribute("NumberOfComponents").expect("a number").parse().expect("a number");
        let (name, values) = (node.attribute("Name").expect("a name"), values(node));
        assert!(values.len().is_multiple_of(components));
        (format!("{section}/{name}"), values)
    };
    found.map(name).collect()
}

/// Numbers of an attribute of the first element of a name.
fn numbers(document: &Document<'_>, element: &str, attribute: &str) -> Vec<f64> {
    let node = document.descendants().find(|node| node.has_tag_name(element)).expect(element);
    node.attribute(attribute).expect(attribute).split(' ').map(|number| number.parse().expect(number)).collect()
}

/// Times and names of the files in a list.
fn listed(text: &str) -> Vec<(f64, String)> {
    let document = Document::parse(text).expect("XML");
    let sets = document.descendants().filter(|node| node.has_tag_name("DataSet"));
    let entry = |node: Node<'_, '_>| {
        let [time, file] = ["timestep", "file"].map(|name| node.attribute(name).expect(name));
        (time.parse().expect(time), file.to_owned())
    };
    sets.map(entry).collect()
}

/// Three components of each vector.
fn flat(vectors: &[Vec2]) -> Vec<f64> {
    vectors.iter().flat_map(|v| [v.x, v.y, 0.0]).collect()
}

/// Centres of the cells of an image, as VTK numbers them.
fn centres(text: &str) -> Vec<Vec2> {
    let document = Document::parse(text).expect("XML");
    let extent = numbers(&document, "ImageData", "WholeExtent");
    assert_eq!(extent, numbers(&document, "Piece", "Extent"));
    let [origin, spacing] = ["Origin", "Spacing"].map(|name| numbers(&document, "ImageData", name));
    let centre = |i: usize, j: usize| {
        Vec2::new(origin[0] + (i as f64 + 0.5) * spacing[0], origin[1] + (j as f64 + 0.5) * spacing[1])
    };
    let [nx, ny] = [extent[1] as usize, extent[3] as usize];
    (0..ny).flat_map(|j| (0..nx).map(move |i| centre(i, j))).collect()
}

#[test]
fn cells_of_an_image_lie_where_they_were_sampled() {
    let raster = Raster::new([-1.0, 2.0], [4.0, 3.0], [8, 5], [true, false]).unwrap();
    let (points, field) = (raster.points(), |p: &Vec2| p.x + 10.0 * p.y);
    let file = VtkFile::image(raster)
        .cell_scalars("pressure", points.iter().map(field))
        .cell_vectors("velocity", points.iter().copied())
        .point_scalars("corner", (0..54).map(f64::from));
    let text = file.document().unwrap();
    let (centres, arrays) = (centres(&text), arrays(&text));
    assert!(near(&arrays["CellData/pressure"], &centres.iter().map(field).collect::<Vec<_>>(), 1e-5));
    assert!(near(&arrays["CellData/velocity"], &flat(&centres), 1e-6));
    assert!(near(&arrays["PointData/corner"], &(0..54).map(f64::from).collect::<Vec<_>>(), 0.0));
}

#[test]
fn lines_and_triangles_have_their_points_and_corners() {
    let points: Vec<Vec2> = (0..7).map(f64::from).map(|k| Vec2::new(0.1 * k, (0.7 * k).sin())).collect();
    let file = VtkFile::closed_lines(&[points[..3].to_vec(), points[3..].to_vec()])
        .point_vectors("force", points.iter().map(|p| 2.0 * p))
        .cell_scalars("droplet", [0.0, 1.0]);
    let read = arrays(&file.document().unwrap());
    assert!(near(&read["Points/Points"], &flat(&points), 0.0));
    assert_eq!(read["Lines/connectivity"], [0.0, 1.0, 2.0, 0.0, 3.0, 4.0, 5.0, 6.0, 3.0]);
    assert_eq!((&read["Lines/offsets"][..], &read["CellData/droplet"][..]), (&[4.0, 9.0][..], &[0.0, 1.0][..]));
    assert!(near(&read["PointData/force"], &flat(&points).iter().map(|v| 2.0 * v).collect::<Vec<_>>(), 1e-6));

    let file = VtkFile::triangles(&points, &[[0, 1, 2], [6, 4, 2]]).cell_vectors("flux", [points[1], points[2]]);
    let read = arrays(&file.document().unwrap());
    assert_eq!(read["Cells/connectivity"], [0.0, 1.0, 2.0, 6.0, 4.0, 2.0]);
    assert_eq!((&read["Cells/offsets"][..], &read["Cells/types"][..]), (&[3.0, 6.0][..], &[5.0, 5.0][..]));
    assert!(near(&read["CellData/flux"], &flat(&points[1..3]), 1e-7));
}

#[test]
fn a_series_lists_its_files_at_their_times() {
    let directory = Directory::new("series");
    let mut series = VtkSeries::create(&directory.0, "line").unwrap();
    let times = [0.0, 0.125, 7.5, 1e-3_f64.mul_add(3.0, 40.0)];
    for (k, time) in times.into_iter().enumerate() {
        let line = [0.0, 1.0, 2.0].map(|x| Vec2::new(x, time));
        let file = VtkFile::closed_lines(&[line.to_vec()]).cell_scalars("number", [k as f64]);
        series.push(time, &file).unwrap();
        // The list is whole after each file.
        let listed = listed(&directory.text("line.pvd"));
        assert_eq!(listed.iter().map(|(time, _)| *time).collect::<Vec<_>>(), times[..=k]);
    }
    for (k, (time, file)) in listed(&directory.text("line.pvd")).into_iter().enumerate() {
        let read = arrays(&directory.text(&file));
        assert_eq!((read["CellData/number"][0], read["Points/Points"][1]), (k as f64, time));
    }
}

/// The flow and the interface of a run, at the times of the run.
#[test]
fn a_run_comes_back() {
    let directory = Directory::new("run");
    let setup = Setup { step: StepSize::Fixed(0.025), ..Setup::default() };
    let Built { mut scene, droplets, .. } = setup.build().unwrap();
    let raster = Raster::of(scene.system(), 0.1).unwrap();
    let mut files = ParaView::create(&directory.0, raster).unwrap();
    scene.run(0.2).observe(Every::Time(0.1), &mut files).go().unwrap();
    let seen = Snapshot::take(scene.system_mut(), raster).unwrap();
    for name in ["fields", "interface"] {
        let times: Vec<f64> = listed(&directory.text(&format!("{name}.pvd"))).iter().map(|(time, _)| *time).collect();
        assert!(near(&times, &[0.0, 0.1, 0.2], 1e-12), "{times:?}");
    }
    let last = |name: &str| directory.text(&listed(&directory.text(name)).last().unwrap().1);
    let (text, interface) = (last("fields.pvd"), arrays(&last("interface.pvd")));
    let fields = arrays(&text);
    assert!(near(&fields["CellData/pressure"], &seen.pressure(), 1e-5 * seen.pressure()[0].abs().max(1.0)));
    assert!(near(&fields["CellData/velocity"], &flat(&seen.velocity()), 1e-6));
    let droplet = scene.body(droplets[0]).unwrap();
    assert!(near(&interface["Points/Points"], &flat(droplet.markers()), 0.0));
    let tensions = droplet.tensions();
    let before = tensions.iter().cycle().skip(tensions.len() - 1);
    let means: Vec<f64> = tensions.iter().zip(before).map(|(a, b)| 0.5 * (a + b)).collect();
    assert!(near(&interface["PointData/tension"], &means, 1e-5 * means[0]));
    // The vorticity is the curl of the velocities beside a cell, far from the interface where these are smooth.
    let (centres, [nx, ny]) = (centres(&text), raster.cells());
    let far = |p: Vec2| (p - seen.droplets[0].centroid).length() > 2.0;
    let (velocity, vorticity) = (&fields["CellData/velocity"], &fields["CellData/vorticity"]);
    let largest = vorticity.iter().fold(0.0_f64, |largest, v| largest.max(v.abs()));
    let (mut worst, mut seen) = (0.0_f64, 0.0_f64);
    for j in 1..ny - 1 {
        for i in (1..nx - 1).filter(|i| far(centres[j * nx + i])) {
            let at = |i: usize, j: usize, k: usize| velocity[3 * (j * nx + i) + k];
            let step = centres[1].x - centres[0].x;
            let across = at(i + 1, j, 1) - at(i - 1, j, 1) - at(i, j + 1, 0) + at(i, j - 1, 0);
            worst = worst.max((across / (2.0 * step) - vorticity[j * nx + i]).abs());
            seen = seen.max(vorticity[j * nx + i].abs());
        }
    }
    assert!(worst < 0.02 * seen && seen > 1e-3 * largest, "{worst} {seen} {largest}");
}

/// A run that goes on from a checkpoint continues the numbers of the files, also where the checkpoint is of the time of
/// one, which is not written again.
#[test]
fn a_resumed_run_continues_its_files() {
    let directory = Directory::new("resumed");
    let setup = Setup { step: StepSize::Fixed(0.025), ..Setup::default() };
    let mut saved = None;
    for end in [0.1, 0.2] {
        let mut scene = setup.build().unwrap().scene;
        saved.iter().for_each(|saved| scene.resume(saved).unwrap());
        let raster = Raster::of(scene.system(), 0.5).unwrap();
        let mut files = ParaView::create(&directory.0, raster).unwrap();
        scene.run(end).observe(Every::Time(0.05), &mut files).go().unwrap();
        saved = Some(scene.checkpoint(""));
    }
    let found = listed(&directory.text("fields.pvd"));
    let times: Vec<f64> = found.iter().map(|(time, _)| *time).collect();
    assert!(near(&times, &[0.0, 0.05, 0.1, 0.15, 0.2], 1e-12), "{times:?}");
    assert_eq!(found[4].1, "fields_0004.vti");
}

/// Stresses, numbers and displacements of elastic walls that a droplet deforms.
#[test]
fn solids_come_back() {
    let directory = Directory::new("solids");
    let setup = Setup {
        region: Region::Channel { length: 8.0, width: 5.4, drive: Drive::ZeroGradient },
        method: Method::Layers(LayersMethod { spacing: 0.2, ..LayersMethod::default() }),
        solids: SolidSetup::walls(&ChannelShape::Straight { width: 2.4 }, &Material::Springs { shear: 100.0 }),
        ..Setup::default()
    };
    let Built { mut scene, .. } = setup.build().unwrap();
    scene.run(0.05).go().unwrap();
    let raster = Raster::of(scene.system(), 0.4).unwrap();
    let mut files = ParaView::create(&directory.0, raster).unwrap();
    files.observe(scene.system_mut()).unwrap();
    let read = arrays(&directory.text("solids_0000.vtu"));
    let solids: Vec<&Solid> = scene.system().bodies::<Solid>().map(|(_, solid)| solid).collect();
    let stresses: Vec<_> = solids.iter().flat_map(|solid| solid.stresses().unwrap()).collect();
    let parts: Vec<[f64; 3]> = stresses.iter().map(|s| [s.x_axis.x, s.y_axis.x, s.y_axis.y]).collect();
    let [xx, xy, yy] = [0, 1, 2].map(|k| parts.iter().map(|part| part[k]).collect::<Vec<f64>>());
    let largest = xx.iter().chain(&yy).fold(0.0_f64, |largest, v| largest.max(v.abs()));
    assert!(largest > 1e-3, "{largest}");
    let deviator = |k: usize| (0.25 * (xx[k] - yy[k]).powi(2) + xy[k].powi(2)).sqrt();
    for (name, expected) in [
        ("stress_deviator", (0..xx.len()).map(deviator).collect()),
        ("stress_xx", xx.clone()),
        ("stress_xy", xy.clone()),
        ("stress_yy", yy.clone()),
        ("J", solids.iter().flat_map(|solid| solid.jacobians()).collect()),
    ] {
        assert!(near(&read[&format!("CellData/{name}")], &expected, 1e-6 * largest.max(1.0)), "{name}");
    }
    let counts = solids.iter().map(|solid| solid.mesh().triangles().len());
    let numbers: Vec<f64> = counts.enumerate().flat_map(|(k, count)| vec![k as f64; count]).collect();
    assert_eq!(read["CellData/solid"], numbers);
    let displaced = read["PointData/displacement"].iter().fold(0.0_f64, |largest, v| largest.max(v.abs()));
    let expected =
        solids.iter().flat_map(|solid| solid.displacements()).fold(0.0_f64, |m, d| m.max(d.abs().max_element()));
    assert!((displaced / expected - 1.0).abs() < 1e-6, "{displaced} {expected}");
}
