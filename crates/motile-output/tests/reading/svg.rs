//! Plots as SVG files.

use motile_output::plot::{AxisScale, Figure, Marker, Plot, SERIES_COLOURS, Series};
use roxmltree::{Document, Node};

/// Lines of a path, by the ends of their segments.
pub(crate) fn lines(path: Node<'_, '_>) -> Vec<Vec<[f64; 2]>> {
    let spaced = |c: char| match c {
        '-' => " -".to_owned(),
        c if c.is_ascii_alphabetic() => format!(" {c} "),
        c => c.to_string(),
    };
    let data: String = path.attribute("d").expect("path data").chars().map(spaced).collect();
    let (mut lines, mut letter, mut numbers): (Vec<Vec<[f64; 2]>>, _, Vec<f64>) = (Vec::new(), "M", Vec::new());
    for token in data.split_whitespace() {
        if token.starts_with(|c: char| c.is_ascii_alphabetic()) {
            letter = token;
            continue;
        }
        numbers.push(token.parse().expect(token));
        let needed = match letter {
            "M" | "l" => 2,
            "q" => 4,
            "c" => 6,
            other => panic!("{other} is no command with numbers"),
        };
        if numbers.len() == needed {
            let [x, y] = [numbers[needed - 2], numbers[needed - 1]];
            numbers.clear();
            match (letter, lines.last_mut()) {
                ("M", _) => lines.push(vec![[x, y]]),
                (_, Some(line)) => {
                    let [left, top] = line[line.len() - 1];
                    line.push([left + x, top + y]);
                }
                (_, None) => panic!("a path begins with {letter}"),
            }
        }
    }
    lines
}

/// Elements of paths of a stroke's colour.
pub(crate) fn strokes<'a>(document: &'a Document<'a>, colour: [u8; 3]) -> Vec<Vec<Vec<[f64; 2]>>> {
    let [r, g, b] = colour;
    let hex = format!("#{r:02x}{g:02x}{b:02x}");
    document.descendants().filter(|node| node.attribute("stroke") == Some(&hex)).map(lines).collect()
}

/// Texts with the centres of their outlines.
pub(crate) fn texts<'a>(document: &'a Document<'a>) -> Vec<(String, [f64; 2])> {
    let centre = |node: Node<'_, '_>| {
        let points = lines(node).concat();
        [0, 1].map(|k| {
            let values = points.iter().map(|p| p[k]);
            0.5 * (values.clone().fold(f64::INFINITY, f64::min) + values.fold(f64::NEG_INFINITY, f64::max))
        })
    };
    let labelled = document.descendants().filter_map(|node| Some((node.attribute("aria-label")?.to_owned(), node)));
    labelled.map(|(label, node)| (label, centre(node))).collect()
}

/// Number in plain writing or as a power of ten, `×10^{−4}` or `10^{3}`.
fn number(text: &str) -> Option<f64> {
    let text = text.replace('−', "-");
    let power = |text: &str| text.strip_prefix("10^{")?.strip_suffix('}')?.parse().ok().map(|n| 10f64.powi(n));
    match text.split_once('×') {
        Some(("", ten)) => power(ten),
        Some((factor, ten)) => Some(factor.parse::<f64>().ok()? * power(ten)?),
        None => power(&text).or_else(|| text.parse().ok()),
    }
}

/// Rectangle of the axes: left, top, right and bottom.
pub(crate) fn area(document: &Document<'_>) -> [f64; 4] {
    let border = strokes(document, [34, 38, 46]).into_iter().flatten().find(|line| line.len() == 5);
    let [a, _, c, ..] = border.expect("a border")[..] else { panic!("five points") };
    [a[0], a[1], c[0], c[1]]
}

/// Points of a line on a plot in the units of its axes, which the tick labels and the factors of the axes tell.
fn read(document: &Document<'_>, line: &[[f64; 2]], scales: [AxisScale; 2]) -> Vec<[f64; 2]> {
    let [left, top, right, bottom] = area(document);
    let texts = texts(document);
    let straight = |k: usize, v: f64| if scales[k] == AxisScale::Linear { v } else { v.log10() };
    let axis = |k: usize| {
        let beside =
            |[x, y]: [f64; 2]| if k == 0 { y > bottom && y < bottom + 20.0 } else { x < left && y > top - 8.0 };
        let factor = texts.iter().filter(|(label, at)| label.starts_with('×') && (at[1] < top) == (k == 1));
        let factor = factor.map(|(label, _)| number(label).expect(label)).next().unwrap_or(1.0);
        let ticks: Vec<(f64, f64)> = texts
            .iter()
            .filter(|(label, at)| beside(*at) && !label.starts_with('×'))
            .filter_map(|(label, at)| Some((at[k], straight(k, number(label)? * factor))))
            .collect();
        assert!(ticks.len() >= 2, "{texts:?}");
        let by = |wanted: fn(&(f64, f64), &(f64, f64)) -> bool| {
            ticks.iter().copied().reduce(|a, b| if wanted(&a, &b) { a } else { b }).expect("a tick")
        };
        let (low, high) = (by(|a, b| a.1 < b.1), by(|a, b| a.1 > b.1));
        move |pixel: f64| low.1 + (pixel - low.0) * (high.1 - low.1) / (high.0 - low.0)
    };
    let (x, y) = (axis(0), axis(1));
    assert!(line.iter().all(|p| (left..=right).contains(&p[0]) && (top..=bottom).contains(&p[1])));
    line.iter().map(|p| [x(p[0]), y(p[1])]).collect()
}

#[test]
fn data_come_back_by_the_labels_of_linear_axes() {
    for (wide, high) in [(1.0, 3e-5), (4e7, 1.0), (0.02, 40.0), (3e-4, 7e6), (1e-3, 1e5)] {
        let points: Vec<[f64; 2]> =
            (0..=20).map(f64::from).map(|k| [wide * k / 20.0, high * (0.3 * k).sin()]).collect();
        let plot = Plot::new("a sine").x_axis("x", AxisScale::Linear).y_axis("y", AxisScale::Linear);
        let plot = plot.series(Series::line("", points.iter().map(|p| (p[0], p[1]))));
        let text = Figure::new(1).panel(plot).svg().unwrap();
        let document = Document::parse(&text).unwrap();
        let found = &strokes(&document, SERIES_COLOURS[0].0)[0][0];
        let back = read(&document, found, [AxisScale::Linear; 2]);
        for (k, size) in [wide, 2.0 * high].into_iter().enumerate() {
            let [read, written] = [&back, &points].map(|list| list.iter().map(|p| p[k]).collect::<Vec<f64>>());
            assert!(super::near(&read, &written, 0.012 * size), "{wide} {high}: {read:?} {written:?}");
        }
    }
}

#[test]
fn data_come_back_by_the_labels_of_logarithmic_axes() {
    let points = [[1e-3, 2.0], [0.01, 30.0], [0.5, 0.4], [30.0, 900.0]];
    let log = AxisScale::Logarithmic;
    let series = Series::line("", points.map(|p| (p[0], p[1])));
    let plot = Plot::new("").x_axis("x", log).y_axis("y", log).series(series);
    let text = Figure::new(1).panel(plot).svg().unwrap();
    let document = Document::parse(&text).unwrap();
    let back = read(&document, &strokes(&document, SERIES_COLOURS[0].0)[0][0], [log; 2]);
    for (read, written) in back.iter().zip(points) {
        assert!(super::near(read, &written.map(f64::log10), 0.06), "{read:?} {written:?}");
    }
}

#[test]
fn panels_stand_in_rows_and_markers_at_their_points() {
    let panel = |title: &str, marker| {
        Plot::new(title).series(Series::points("", [(0.0, 0.0), (1.0, 2.0)]).marker(marker)).horizontal(1.0, "half")
    };
    let figure = ["first", "second", "third"].into_iter().zip([Marker::Square, Marker::Triangle, Marker::Diamond]);
    let figure = figure.fold(Figure::new(2), |figure, (title, marker)| figure.panel(panel(title, marker)));
    let text = figure.svg().unwrap();
    let document = Document::parse(&text).unwrap();
    let root = document.root_element();
    assert_eq!([root.attribute("width"), root.attribute("height")], [Some("1080"), Some("680")]);
    let texts = texts(&document);
    let at = |label: &str| texts.iter().filter(|text| text.0 == label).map(|text| text.1).collect::<Vec<_>>();
    let [first, second, third] = ["first", "second", "third"].map(|label| at(label)[0]);
    assert!((second[0] - first[0] - 540.0).abs() < 30.0 && (second[1] - first[1]).abs() < 3.0);
    assert!((third[0] - first[0]).abs() < 30.0 && (third[1] - first[1] - 340.0).abs() < 3.0);
    assert_eq!(at("half").len(), 3);
    // Outlines of the markers, around the points of the data; that of the middle is the reference line's height.
    let [r, g, b] = SERIES_COLOURS[0].0;
    let colour = format!("#{r:02x}{g:02x}{b:02x}");
    let corners = |wanted: usize| {
        let filled = document.descendants().filter(|node| node.attribute("fill") == Some(&colour));
        filled.map(lines).filter(|outline| outline[0].len() == wanted).collect::<Vec<_>>()
    };
    assert_eq!([corners(4).len(), corners(5).len()], [2, 4]);
    for marker in corners(4) {
        let [top, right, left, _] = marker[0][..] else { panic!("four points") };
        assert!(
            top[1] < right[1] && (right[1] - left[1]).abs() < 0.11 && (top[0] * 2.0 - left[0] - right[0]).abs() < 0.4
        );
    }
    let square = &corners(5)[0][0];
    let [left, _, _, bottom] = area(&document);
    let middle = [0, 1].map(|k| 0.5 * (square[0][k] + square[2][k]));
    assert!(
        middle[0] > left && middle[0] < left + 60.0 && middle[1] > bottom - 60.0 && middle[1] < bottom,
        "{middle:?}"
    );
    // Dashes of the reference line are halfway between the markers.
    let grey = strokes(&document, [128, 134, 144]);
    let other = &corners(5)[1][0];
    let upper = 0.5 * (other[0][1] + other[2][1]);
    assert!((grey[0][0][0][1] - 0.5 * (middle[1] + upper)).abs() < 0.2, "{grey:?}");
    assert!(grey[0].len() > 10 && grey[0].windows(2).all(|pair| pair[1][0][0] > pair[0][1][0]));
}
