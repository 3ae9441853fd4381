use super::*;
use crate::{BoxFlags, ChannelFlags, Drive, DropletFlags, Initial, MethodFlags, OutputFlags, Preset};
use clap::CommandFactory as _;
use motile::{
    Method,
    ib_core::{AnyKernel, StepSize},
};

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
                --no-pictures --out somewhere --width 2 --length 8 --lateral-offset -0.2 --drive zero-flux";
    let flags = parse(line).unwrap();
    assert_eq!((flags.droplet.activity, flags.droplet.excluded_volume, flags.droplet.viscosity), (-4.0, 8.0, 10.0));
    assert_eq!((flags.droplet.angle, flags.droplet.initial, flags.droplet.seed), (-30.0, Initial::Perturbed, 7));
    assert_eq!((flags.region.side, flags.region.offset), (12.0, [-0.03, 0.01]));
    assert_eq!((flags.method.spacing(), flags.method.time, flags.method.step()), (0.1, 250.0, StepSize::OfLimit(0.5)));
    assert_eq!((flags.method.kernel, flags.method.preset), (Some(AnyKernel::Gaussian6), Preset::Thesis));
    assert_eq!((flags.channel.lateral_offset, flags.channel.drive), (-0.2, Drive::ZeroFlux));
    assert!(flags.output.no_pictures && flags.output.out.as_deref() == Some("somewhere".as_ref()));
}

#[test]
fn presets_set_what_is_not_said() {
    let swimmer = |line: &str| {
        let flags = parse(line).unwrap();
        flags.droplet.swimmer(&flags.method)
    };
    let thesis = swimmer("--preset thesis");
    assert_eq!((thesis.step, thesis.kernel), (StepSize::Fixed(1e-3), AnyKernel::Peskin4));
    assert!(!thesis.corrected && thesis.area_constraint);
    let accurate = swimmer("");
    assert_eq!((accurate.step, accurate.kernel), (StepSize::OfLimit(0.5), AnyKernel::BSpline4));
    let mixed = swimmer("--preset thesis --dt auto --kernel bspline5");
    assert_eq!((mixed.step, mixed.kernel), (StepSize::OfLimit(0.5), AnyKernel::BSpline5));
}

#[test]
fn the_method_follows_from_the_flags() {
    let method = |line: &str| {
        let flags = parse(line).unwrap();
        flags.region.check(&flags.method).map(|()| flags.method.method()).map_err(|e| e.to_string())
    };
    for line in ["", "--nodes 64", "--spacing 0.1 --method boundary-integral", "--nodes 64 --spacing 0.1"] {
        assert_eq!(method(line), Ok(Method::BoundaryIntegral), "{line}");
    }
    for line in ["--spacing 0.1", "--kernel roma3", "--preset thesis", "--contrast-method arithmetic"] {
        assert_eq!(method(line), Ok(Method::ImmersedBoundary), "{line}");
    }
    for line in [
        "--method immersed-boundary --nodes 64",
        "--method boundary-integral --kernel roma3",
        "--nodes 96 --concentration-cells 64",
    ] {
        assert!(method(line).is_err(), "{line}");
    }
}

#[test]
fn viscosities_inside_and_outside() {
    let viscosities = |line: &str| {
        let flags = parse(line).unwrap();
        let swimmer = flags.droplet.swimmer(&flags.method);
        (swimmer.viscosity_inside.unwrap_or(swimmer.viscosity), swimmer.viscosity)
    };
    assert_eq!(viscosities("--viscosity 7"), (7.0, 7.0));
    assert_eq!(viscosities("--viscosity-in 1000 --viscosity-out 10"), (1000.0, 10.0));
    assert_eq!(viscosities("--viscosity-in 1000"), (1000.0, 100.0));
    assert_eq!(viscosities("--viscosity-out 10"), (100.0, 10.0));
}

#[test]
fn what_is_wrong_is_said_in_one_sentence() {
    let cases = [
        ("--viscosity -3", "--viscosity -3: must be a number above 0 and at most 1e6"),
        ("--viscosity nan", "--viscosity nan: must be a number above 0 and at most 1e6"),
        ("--box 0", "--box 0: must be a number above 0 and at most 1e6"),
        ("--dt soon", "--dt soon: must be a number above 0, 'auto', 'adaptive' or 'adaptive:' and a tolerance"),
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
        ("--activity 1", "--activity 1: must be a number from -1e6 to 0 (contractile activities are negative)"),
    ];
    for (line, expected) in cases {
        assert_eq!(parse(line).unwrap_err(), expected, "{line}");
    }
}

#[test]
fn causes_are_told_once() {
    let error = anyhow::anyhow!("no such file").context("at time 3: no such file").context("reading");
    assert_eq!(chain(&error), "reading: at time 3: no such file");
}

#[test]
fn regions_that_do_not_fit_are_refused() {
    let cells = |line: &str| {
        let flags = parse(line).unwrap();
        flags.region.check(&flags.method).map_err(|e| e.to_string())
    };
    let side = |line: &str| parse(line).unwrap().method.cells(6.0, "box").map_err(|e| e.to_string());
    assert_eq!(side("--spacing 0.05"), Ok(120));
    assert_eq!(side("--spacing 0.1"), Ok(60));
    for line in ["--box 1.5", "--box 1e5", "--box 6 --spacing 1", "--box 6 --spacing 0.07", "--box 600 --spacing 0.01"]
    {
        assert!(cells(line).is_err(), "{line}");
    }
    assert!(cells("--time 1 --dt 2").is_err() && cells("--time 1e4 --dt 1e-9").is_err());
    let channel = |line: &str| {
        let flags = parse(line).unwrap();
        flags.channel.check(&flags.method).map_err(|e| e.to_string())
    };
    assert_eq!(channel("--width 2 --length 12 --spacing 0.05"), Ok(()));
    assert!(channel("--width 1.9").is_err() && channel("--width 3 --lateral-offset 0.6").is_err());
}
