//! Command lines of the examples.

use crate::{BoxFlags, ChannelFlags, DropletFlags, MethodFlags, Preset};
use clap::{CommandFactory as _, Parser};
use motile::base::Region;
use motile::ib_core::AnyKernel;
use motile::scene::StepSize;
use motile::setup::{
    Distribution, DropletSetup, ExcludedVolume, GridMethod, LayersMethod, Method, MethodKind, Setup, Start,
    SuspensionSetup,
};
use motile_cli::command_line::sentence;
use motile_cli::run::OutputFlags;

#[derive(Debug, Parser)]
struct Flags {
    #[command(flatten)]
    droplet: DropletFlags,
    #[command(flatten)]
    region: BoxFlags,
    #[command(flatten)]
    channel: ChannelFlags,
    #[command(flatten)]
    method: MethodFlags,
    #[command(flatten)]
    output: OutputFlags,
}

fn parse(line: &str) -> Result<Flags, String> {
    Flags::try_parse_from(std::iter::once("test").chain(line.split_whitespace()))
        .map_err(|e| sentence(&e, &Flags::command()))
}

#[test]
fn all_flags_with_their_values() {
    let line = "--activity -4 --excluded-volume 8 --viscosity 10 --box 12 --spacing 0.1 --dt auto --time 250 \
                --angle -30 --offset -0.03,0.01 --kernel gaussian6 --preset thesis --initial perturbed --seed 7 \
                --no-pictures --out somewhere --width 2.5 --length 8 --lateral-offset -0.2 --drive zero-flux";
    let flags = parse(line).unwrap();
    assert_eq!((flags.method.time, flags.method.preset), (250.0, Preset::Thesis));
    assert!(flags.output.no_pictures && flags.output.out.as_deref() == Some("somewhere".as_ref()));
    let mut setup = setup(line).unwrap();
    let Method::Grid(grid) = setup.method else { panic!("{setup:?}") };
    assert_eq!((grid.spacing, grid.kernel, setup.step), (0.1, AnyKernel::Gaussian6, StepSize::OfLimit(0.5)));
    assert_eq!((setup.viscosity, setup.region), (10.0, Region::Box { lengths: [12.0, 12.0] }));
    let DropletSetup { centre, angle, particles: Some(particles), .. } = setup.droplets[0] else { panic!("{setup:?}") };
    assert_eq!((centre, angle, particles.activity), ([-0.03, 0.01], f64::to_radians(-30.0), -4.0));
    assert_eq!(particles.excluded_volume, ExcludedVolume::Step(8.0));
    assert_eq!(particles.start, Start::Perturbed { amplitude: 0.05, seed: 7 });
    flags.channel.apply(&mut setup).unwrap();
    assert_eq!(setup.region, Region::Channel { length: 8.0, width: 2.5, drive: motile::base::Drive::ZeroFlux });
    assert_eq!(setup.droplets[0].centre, [0.0, -0.2]);
}

/// Flags of droplets and particles are refused where there are none.
#[test]
fn flags_of_what_there_is_not() {
    let passive = || Some(Setup { droplets: vec![DropletSetup::passive(5.0)], ..Setup::default() });
    let none = || Some(Setup { droplets: Vec::new(), ..Setup::default() });
    assert!(over(passive(), "--angle 10 --viscosity-in 3 --offset 1,0").is_ok());
    assert!(over(none(), "--viscosity 3").is_ok());
    for (file, line) in [
        (passive(), "--activity -3"),
        (passive(), "--seed 3"),
        (none(), "--initial polarised"),
        (none(), "--angle 10"),
        (none(), "--offset 1,0"),
    ] {
        let error = over(file, line).unwrap_err();
        assert!(error.contains("means nothing in a scene") && error.contains(&line[..6]), "{error}");
    }
}

/// The scene of a command line, in a box.
fn setup(line: &str) -> Result<Setup, String> {
    over(None, line)
}

/// Scene of a command line over a scene file.
fn over(file: Option<Setup>, line: &str) -> Result<Setup, String> {
    let flags = parse(line).unwrap();
    let setup = || {
        let mut setup = flags.method.setup(&flags.droplet, file)?;
        flags.region.apply(&mut setup)?;
        Ok(setup)
    };
    setup().map_err(|error: anyhow::Error| error.to_string())
}

#[test]
fn presets_set_what_is_not_said() {
    assert_eq!(setup("--preset thesis").unwrap(), Setup::thesis());
    assert_eq!(setup("").unwrap(), Setup::default());
    let mixed = setup("--preset thesis --dt auto --kernel bspline5").unwrap();
    let grid = GridMethod { kernel: AnyKernel::BSpline5, ..GridMethod::thesis() };
    assert_eq!(mixed, Setup { method: Method::Grid(grid), step: StepSize::OfLimit(0.5), ..Setup::thesis() });
    // A contrast on the grid has no mobility correction.
    assert!(matches!(setup("--preset thesis --viscosity-in 10").unwrap().method, Method::Grid(_)));
    let refused = setup("--method grid --spacing 0.1 --viscosity-in 10").unwrap_err();
    assert!(refused.contains("give --method layers"), "{refused}");
}

#[test]
fn flags_override_a_scene_file_and_leave_the_rest() {
    let file = Setup {
        region: Region::Plane,
        viscosity: 7.0,
        step: StepSize::Fixed(1e-2),
        droplets: vec![
            DropletSetup { centre: [1.0, 2.0], viscosity: Some(3.0), ..DropletSetup::active(-5.0) },
            DropletSetup { centre: [5.0, 2.0], ..DropletSetup::passive(3.0) },
        ],
        ..Setup::default()
    };
    assert_eq!(over(Some(file.clone()), "").unwrap(), file);
    let mut expected = file.clone();
    expected.droplets[0] = DropletSetup { centre: [1.0, 2.0], ..DropletSetup::active(-1.0) };
    expected.droplets.iter_mut().for_each(|droplet| droplet.viscosity = Some(9.0));
    expected.region = Region::Box { lengths: [20.0, 20.0] };
    expected.method = Method::Layers(LayersMethod::of_spacing(0.1));
    let line = "--activity -1 --viscosity-in 9 --box 20 --method layers --spacing 0.1";
    assert_eq!(over(Some(file.clone()), line).unwrap(), expected);
    for flag in ["--offset 0,0.5", "--angle 3"] {
        let error = over(Some(file.clone()), flag).unwrap_err();
        assert!(error.contains("this scene has several"), "{error}");
    }
    // A grid spacing does not turn a scene of boundary integrals into a scene on a grid.
    assert_eq!(over(Some(file), "--spacing 0.1").unwrap().method.kind(), MethodKind::Integral);
}

/// Flags of droplets change all of them, in a suspension too.
#[test]
fn flags_change_all_droplets() {
    let two = || {
        let other = DropletSetup { name: "other".to_owned(), viscosity: Some(3.0), ..DropletSetup::active(-5.0) };
        Setup { droplets: vec![DropletSetup::active(-2.0), other], viscosity: 8.0, ..Setup::default() }
    };
    let inside =
        |setup: &Setup| setup.droplets.iter().map(|d| d.viscosity.unwrap_or(setup.viscosity)).collect::<Vec<_>>();
    let changed = over(Some(two()), "--activity -4 --viscosity-out 20").unwrap();
    assert!(changed.droplets.iter().all(|droplet| droplet.activity() == -4.0));
    assert_eq!((changed.viscosity, inside(&changed)), (20.0, vec![8.0, 3.0]));
    assert_eq!(inside(&over(Some(two()), "--viscosity-in 7").unwrap()), [7.0, 7.0]);
    let perturbed = over(Some(two()), "--initial perturbed --seed 5").unwrap();
    let seeds = perturbed.droplets.iter().map(|droplet| droplet.particles.unwrap().start);
    assert!(seeds.eq([5, 6].map(|seed| Start::Perturbed { amplitude: 0.05, seed })));

    let activity = Some(Distribution::Between([-3.0, -2.0]));
    let suspension = SuspensionSetup { count: Some(4), activity, ..SuspensionSetup::default() };
    let many = Setup { droplets: Vec::new(), suspension: vec![suspension], ..Setup::default() };
    let placed = over(Some(many), "--activity -4").unwrap().placed().unwrap();
    assert!(placed.droplets.len() == 4 && placed.droplets.iter().all(|droplet| droplet.activity() == -4.0));
}

#[test]
fn a_seed_is_that_of_a_random_start() {
    let start =
        |file: Option<Setup>, line: &str| over(file, line).map(|setup| setup.droplets[0].particles.unwrap().start);
    let perturbed = |seed| Ok(Start::Perturbed { amplitude: 0.05, seed });
    assert_eq!(start(None, "--initial perturbed"), perturbed(1));
    assert_eq!(start(None, "--initial perturbed --seed 3"), perturbed(3));
    assert_eq!(start(Some(setup("--initial perturbed").unwrap()), "--seed 4"), perturbed(4));
    let refused = start(None, "--seed 3").unwrap_err();
    assert_eq!(refused, "--seed 3 means nothing without --initial perturbed: leave it out or give that");
}

#[test]
fn the_method_follows_from_the_flags() {
    let method = |line: &str| setup(line).map(|setup| setup.method.kind());
    for line in ["", "--nodes 64", "--spacing 0.1 --method integral", "--nodes 64 --spacing 0.1", "--spacing 0.1"] {
        assert_eq!(method(line), Ok(MethodKind::Integral), "{line}");
    }
    for line in ["--method grid", "--method grid --kernel roma3", "--preset thesis"] {
        assert_eq!(method(line), Ok(MethodKind::Grid), "{line}");
    }
    let layers = setup("--method layers --nodes 64 --spacing 0.1 --kernel bspline5").unwrap().method;
    let expected = LayersMethod { nodes: 64, elements: 256, spacing: 0.1, kernel: AnyKernel::BSpline5 };
    assert_eq!(layers, Method::Layers(expected));
    for line in ["--method grid --nodes 64", "--kernel roma3", "--nodes 96 --elements 64", "--preset thesis --nodes 64"]
    {
        assert!(method(line).is_err(), "{line}");
    }
}

#[test]
fn viscosities_inside_and_outside() {
    let viscosities = |line: &str| {
        let setup = setup(line).unwrap();
        (setup.droplets[0].viscosity.unwrap_or(setup.viscosity), setup.viscosity)
    };
    assert_eq!(viscosities("--viscosity 7"), (7.0, 7.0));
    assert_eq!(viscosities("--viscosity-in 1000 --viscosity-out 10"), (1000.0, 10.0));
    assert_eq!(viscosities("--viscosity-in 1000"), (1000.0, 100.0));
    assert_eq!(viscosities("--viscosity-out 10"), (100.0, 10.0));
}

#[test]
fn what_is_wrong_is_said_in_one_sentence() {
    let cases = [
        ("--viscosity -3", "--viscosity -3: must be a number above 0 and at most 1e50"),
        ("--viscosity nan", "--viscosity nan: must be a number above 0 and at most 1e50"),
        ("--box 0", "--box 0: must be a number above 0 and at most 1e50"),
        (
            "--dt soon",
            "--dt soon: must be a number above 0, 'auto', 'adaptive' or 'adaptive:' and a tolerance of at most 0.5",
        ),
        ("--offset 1", "--offset 1: must be two numbers with a comma between them"),
        (
            "--kernel best",
            "--kernel best: must be one of peskin4, roma3, gaussian6, bspline3, bspline4, bspline5, bspline6",
        ),
        ("--preset best", "--preset best is not one of thesis, accurate"),
        ("--time", "--time needs a value"),
        ("--time 1 --time 2", "--time is given more than once"),
        ("--visc 3", "there is no flag --visc (did you mean --viscosity? --help lists them)"),
        ("--checkpoint-every 5", "the following required arguments were not provided: --checkpoint <FILE>"),
        ("--nonsense", "there is no flag --nonsense (--help lists them)"),
        ("stray", "there is no flag stray (--help lists them)"),
        ("--seed -1", "--seed -1: must be a whole number from 0 to 18446744073709551615"),
        ("--activity inf", "--activity inf: must be a number from -1e50 to 1e50"),
    ];
    for (line, expected) in cases {
        assert_eq!(parse(line).unwrap_err(), expected, "{line}");
    }
}

#[test]
fn regions_that_do_not_fit_are_refused() {
    let build = |setup: Setup| setup.build().map(drop).map_err(|error| error.to_string());
    for line in [
        "--box 1.5",
        "--box 1e5",
        "--method grid --spacing 1",
        "--method grid --box 6 --spacing 0.07",
        "--method grid --box 600 --spacing 0.01",
    ] {
        assert!(setup(line).and_then(build).is_err(), "{line}");
    }
    assert!(setup("--time 1 --dt 2").is_err());
    let channel = |line: &str| {
        let (flags, mut setup) = (parse(line).unwrap(), setup(line)?);
        flags.channel.apply(&mut setup).map_err(|e| e.to_string())?;
        build(setup)
    };
    assert_eq!(channel("--width 2 --length 12 --method grid --spacing 0.05"), Ok(()));
    for line in [
        "--width 1.9",
        "--width 3 --lateral-offset 0.6",
        "--length 1.5",
        "--length 1e5",
        "--method grid --spacing 0.07",
    ] {
        assert!(channel(line).is_err(), "{line}");
    }
}

/// The page on the program gives the key of each flag.
#[test]
fn every_flag_has_a_key() {
    use crate::{AnyRegionFlags, ElasticFlags, GelFlags, RelaxationFlags, TwitchingFlags};
    use clap::Args;
    let page = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/running.md");
    let text = std::fs::read_to_string(page).unwrap();
    let (_, table) = text.split_once("| flag | key").unwrap();
    let mut flags = std::collections::BTreeSet::new();
    for augment in [
        DropletFlags::augment_args,
        AnyRegionFlags::augment_args,
        ChannelFlags::augment_args,
        MethodFlags::augment_args,
        ElasticFlags::augment_args,
        RelaxationFlags::augment_args,
        TwitchingFlags::augment_args,
        GelFlags::augment_args,
    ] {
        let command = augment(clap::Command::new("some"));
        flags.extend(command.get_arguments().filter_map(|flag| flag.get_long().map(str::to_owned)));
    }
    assert!(flags.remove("time") && flags.len() > 50, "{}", flags.len());
    for flag in flags {
        let is_end = |c: Option<char>| !c.is_some_and(|c| c.is_alphanumeric() || c == '-');
        let name = format!("`--{flag}");
        let mut places = table.match_indices(&name).map(|(k, found)| k + found.len());
        assert!(places.any(|end| is_end(table[end..].chars().next())), "--{flag}");
    }
}
