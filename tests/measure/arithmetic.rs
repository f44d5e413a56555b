//! Has the shadow run's arithmetic the digits that its sources prove? Held against floats of 400 bits.

use carom::certify::Double;
use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

use crate::random::Random;

/// A float of 400 bits.
pub(crate) type Big = FBig<HalfEven>;

/// The number itself.
pub(crate) fn big(value: f64) -> Big {
    Big::try_from(value).expect("a finite number").with_precision(400).value()
}

/// Both parts of a double.
pub(crate) fn whole(value: Double) -> Big {
    big(value.value()) + big(value.rest())
}

/// A decimal number below ten: its digits in groups of ten, the point after the first digit.
pub(crate) fn decimal(groups: &[f64]) -> Big {
    let mut unit = big(1e9);
    let mut sum = big(0.0);
    for group in groups {
        sum += big(*group) / &unit;
        unit *= big(1e10);
    }
    sum
}

/// |found − expected|, m or whatever they are in.
pub(crate) fn off(found: Double, expected: &Big) -> f64 {
    f64::try_from((whole(found) - expected).with_precision(53).value()).expect("a finite number").abs()
}

/// |found − expected| / |expected|, in units of 2⁻¹⁰⁶.
fn relative(found: Double, expected: &Big) -> f64 {
    let share = (whole(found) - expected) / expected;
    f64::try_from(share.with_precision(53).value()).expect("a finite number").abs() * 2_f64.powi(106)
}

/// A double with all its bits used, its magnitude in 1e-60 … 1e60.
fn any(random: &mut Random) -> Double {
    let high = random.decade(-60.0, 60.0) * random.pick(&[-1.0, 1.0]);
    Double::from(high) + Double::from(high * random.between(-1.0, 1.0) * f64::EPSILON / 2.0)
}

#[test]
fn sums_products_quotients_and_roots_are_as_near_as_is_proven() {
    let random = &mut Random::new(20);
    for _ in 0..20_000 {
        let (a, b) = (any(random), any(random));
        // near in size, so that most digits of a difference cancel
        let near = a * (Double::ONE + Double::from(random.decade(-30.0, 0.0) * random.between(-1.0, 1.0)));
        let (x, y, z) = (whole(a), whole(b), whole(near));
        let tenth = 0.1; // the terms in u³
        assert!(relative(a + b, &(&x + &y)) <= 3.0 + tenth, "{a:?} + {b:?}");
        if a != near {
            assert!(relative(a - near, &(&x - &z)) <= 3.0 + tenth, "{a:?} - {near:?}");
        }
        assert!(relative(a * b, &(&x * &y)) <= 5.0 + tenth, "{a:?} * {b:?}");
        assert!(relative(a / b, &(&x / &y)) <= 15.0 + tenth, "{a:?} / {b:?}");
        let root = whole(a.abs().sqrt());
        let square = relative(a.abs(), &(&root * &root));
        assert!(square <= 2.0 * 25.0 / 8.0 + tenth, "the root of {a:?}: its square is off by {square}");
    }
}

#[test]
fn well_known_numbers_come_out_to_thirty_digits() {
    let (one, two) = (Double::ONE, Double::from(2.0));
    let root = decimal(&[1_414_213_562.0, 3_730_950_488.0, 168_872_420.0, 9_698_078_569.0]);
    assert!(off(two.sqrt(), &root) < 1e-31);
    let golden = decimal(&[1_618_033_988.0, 7_498_948_482.0, 458_683_436.0, 5_638_117_720.0]);
    assert!(off((one + Double::from(5.0).sqrt()) / two, &golden) < 1e-31);
    let third = decimal(&[333_333_333.0, 3_333_333_333.0, 3_333_333_333.0, 3_333_333_333.0]);
    assert!(off(one / Double::from(3.0), &third) < 1e-31);
    // Σ 1/k!, thirty terms: each of them and each sum rounds.
    let (mut term, mut sum) = (one, one);
    for k in 1..30 {
        term = term / Double::from(f64::from(k));
        sum = sum + term;
    }
    let e = decimal(&[2_718_281_828.0, 4_590_452_353.0, 6_028_747_135.0, 2_662_497_757.0]);
    assert!(off(sum, &e) < 1e-30);
}
