//! The tank of the case study and its sequence: translated, proved equal, and
//! told apart where a rule is missing.

use bench::questions::tank_files;
use criterion::{Criterion, criterion_group, criterion_main};
use logic::Budget;
use proof::{Limits, check};
use verification::program::{Bounds, follow};
use verification::witness::sights;
use verification::{Timing, Verdict, verify};

fn verification(criterion: &mut Criterion) {
    let (program, [spec, without]) = tank_files();
    let limits = Limits::default();
    let both = |spec| verify(&program, spec, Timing::Scan, &limits).expect("a translation");
    assert!(matches!(both(&spec).verdict, Verdict::Equivalent));
    assert!(matches!(both(&without).verdict, Verdict::Different(_)));

    let mut group = criterion.benchmark_group("neutralization");
    group.bench_function("translate the ladder", |bencher| {
        bencher.iter(|| follow(&program, Some(&spec), &Bounds::default()));
    });
    group.bench_function("prove equal", |bencher| bencher.iter(|| both(&spec)));
    let question = both(&spec).question;
    group.bench_function("engines alone", |bencher| {
        bencher.iter(|| check(&question, &limits));
    });
    group.bench_function("tell apart without a rule", |bencher| {
        bencher.iter(|| both(&without));
    });
    let analysis = recovery::analyse(&program, &Budget::default());
    let none = [];
    for (name, environment) in [
        ("see what follows what", &none[..]),
        ("see it in a plant of seven rules", &spec.environment),
    ] {
        group.bench_function(name, |bencher| {
            bencher.iter(|| sights(&analysis, environment, &limits));
        });
    }
    group.finish();
}

criterion_group!(benches, verification);
criterion_main!(benches);
