//! Four numbers at once, with the instructions of the machine.

/// Arithmetic on four numbers, of which each operation is rounded once. Only [`Lanes::mul_add`] differs between
/// machines.
pub(super) trait Lanes: Copy {
    /// The four numbers.
    type Four: Copy;

    /// Returns the four times the same number.
    fn splat(self, value: f64) -> Self::Four;

    /// Returns the numbers of an array.
    fn load(self, values: [f64; 4]) -> Self::Four;

    /// As an array.
    fn store(self, four: Self::Four) -> [f64; 4];

    /// Returns `a + b`, each with each.
    fn add(self, a: Self::Four, b: Self::Four) -> Self::Four;

    /// Returns `a b`, each with each.
    fn mul(self, a: Self::Four, b: Self::Four) -> Self::Four;

    /// Returns `a b + c`, each with each, rounded once where the machine has an instruction for it.
    fn mul_add(self, a: Self::Four, b: Self::Four, c: Self::Four) -> Self::Four;

    /// Returns the sum of the numbers of a and the sum of the numbers of b: first with second and third with fourth,
    /// then the two.
    fn sums(self, a: Self::Four, b: Self::Four) -> [f64; 2];
}

/// Portable code, for every machine.
#[derive(Debug, Clone, Copy)]
pub(super) struct Portable;

impl Lanes for Portable {
    type Four = [f64; 4];

    #[inline(always)]
    fn splat(self, value: f64) -> [f64; 4] {
        [value; 4]
    }

    #[inline(always)]
    fn load(self, values: [f64; 4]) -> [f64; 4] {
        values
    }

    #[inline(always)]
    fn store(self, four: [f64; 4]) -> [f64; 4] {
        four
    }

    #[inline(always)]
    fn add(self, a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
        [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]]
    }

    #[inline(always)]
    fn mul(self, a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
        [a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]]
    }

    #[inline(always)]
    fn mul_add(self, a: [f64; 4], b: [f64; 4], c: [f64; 4]) -> [f64; 4] {
        self.add(self.mul(a, b), c)
    }

    #[inline(always)]
    fn sums(self, a: [f64; 4], b: [f64; 4]) -> [f64; 2] {
        [a, b].map(|[first, second, third, fourth]| (first + second) + (third + fourth))
    }
}

#[cfg(target_arch = "x86_64")]
impl Lanes for pulp::x86::V3 {
    type Four = pulp::f64x4;

    #[inline(always)]
    fn splat(self, value: f64) -> pulp::f64x4 {
        self.splat_f64x4(value)
    }

    #[inline(always)]
    fn load(self, values: [f64; 4]) -> pulp::f64x4 {
        pulp::cast(values)
    }

    #[inline(always)]
    fn store(self, four: pulp::f64x4) -> [f64; 4] {
        pulp::cast(four)
    }

    #[inline(always)]
    fn add(self, a: pulp::f64x4, b: pulp::f64x4) -> pulp::f64x4 {
        self.add_f64x4(a, b)
    }

    #[inline(always)]
    fn mul(self, a: pulp::f64x4, b: pulp::f64x4) -> pulp::f64x4 {
        self.mul_f64x4(a, b)
    }

    #[inline(always)]
    fn mul_add(self, a: pulp::f64x4, b: pulp::f64x4, c: pulp::f64x4) -> pulp::f64x4 {
        self.mul_add_f64x4(a, b, c)
    }

    #[inline(always)]
    fn sums(self, a: pulp::f64x4, b: pulp::f64x4) -> [f64; 2] {
        let (a, b) = (pulp::cast(a), pulp::cast(b));
        let (even, odd) = (self.avx._mm256_unpacklo_pd(a, b), self.avx._mm256_unpackhi_pd(a, b));
        let [a_low, b_low, a_high, b_high]: [f64; 4] = pulp::cast(self.avx._mm256_add_pd(even, odd));
        [a_low + a_high, b_low + b_high]
    }
}

/// Work that is compiled once for every set of instructions.
pub(super) trait LanesTask {
    /// Runs the task.
    fn run<L: Lanes>(self, lanes: L);
}

/// Does `task` with the widest instructions that the machine has.
pub(super) fn dispatch<T: LanesTask>(task: T) {
    #[cfg(target_arch = "x86_64")]
    if let Some(wide) = pulp::x86::V3::try_new() {
        struct Wide<T>(pulp::x86::V3, T);
        impl<T: LanesTask> pulp::NullaryFnOnce for Wide<T> {
            type Output = ();

            #[inline(always)]
            fn call(self) {
                self.1.run(self.0);
            }
        }
        wide.vectorize(Wide(wide, task));
        return;
    }
    task.run(Portable);
}
