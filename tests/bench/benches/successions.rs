//! The order-free rule and the paper's own, on pairs of rungs that share all
//! their variables. Beyond sixteen the paper's rule takes seconds a time and
//! only the other is measured.

use bench::pair::pair;
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use logic::Budget;
use recovery::conditions::conditions;
use recovery::successions::{cubes, possible};

fn successions(criterion: &mut Criterion) {
    let budget = Budget::default();
    let mut group = criterion.benchmark_group("successions");
    group.sample_size(10);
    for variables in [8, 12, 16, 20] {
        let reading = ladder::read(pair(variables).as_bytes());
        let conditions = conditions(&reading.program, &budget);
        group.bench_function(BenchmarkId::new("possible", variables), |bencher| {
            bencher.iter(|| possible(&conditions, &budget));
        });
        if variables <= 16 {
            group.bench_function(BenchmarkId::new("cubes", variables), |bencher| {
                bencher.iter(|| cubes(&conditions, &budget));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, successions);
criterion_main!(benches);
