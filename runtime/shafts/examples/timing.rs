use eigentol_shafts::*;
use std::time::Instant;
fn rotor(speed: f64) -> Assembly {
    let e = 210e9;
    let g = 81e9;
    let sec = |l: f64, d: f64| {
        let a = std::f64::consts::PI * d * d / 4.0;
        let i = std::f64::consts::PI * d.powi(4) / 64.0;
        Section {
            length: l,
            stiffness: e * i,
            shear: 0.9 * g * a,
            mass: 7850.0 * a,
            rotary: 7850.0 * i,
            lag: 0.0,
            tension: 0.0,
            drag: 0.0,
        }
    };
    let stations = [0usize, 8, 16, 30, 38, 46];
    let all: Vec<Section> = (0..46).map(|k| sec(0.03, 0.05 + 0.02 * ((k % 5) as f64) / 5.0)).collect();
    let n = 4 * stations.len();
    let [mut m, mut c, mut k] = [(); 3].map(|()| Matrix::zeros(n, n));
    for b in [8usize, 12] {
        for (j, v) in [30.0, 0.2, 30.0, 0.2].into_iter().enumerate() {
            m[b + j][b + j] = v;
        }
        c[b + 1][b + 3] = 0.4 * speed;
        c[b + 3][b + 1] = -0.4 * speed;
    }
    for b in [4usize, 16] {
        for j in [0, 2] {
            k[b + j][b + j] = 8e7;
            c[b + j][b + j] = 2e3;
        }
    }
    let spans = stations
        .windows(2)
        .enumerate()
        .map(|(q, w)| Span {
            line: Line::Timoshenko,
            speed,
            sections: all[w[0]..w[1]].iter().map(|s| (*s, 1)).collect(),
            ends: [q, q + 1].map(|st| [0, 1, 2, 3].map(|j| Some((4 * st + j, 1.0)))),
        })
        .collect();
    Assembly::new(spans, [m, c, k], 4).unwrap()
}
fn time(name: &str, count: usize, mut f: impl FnMut()) {
    f();
    let mut best = f64::MAX;
    for _ in 0..5 {
        let t = Instant::now();
        for _ in 0..count {
            f();
        }
        best = best.min(t.elapsed().as_secs_f64() / count as f64);
    }
    println!("{name:20} {:10.1} us", best * 1e6);
}
fn main() {
    let r = rotor(400.0);
    let s = Complex::new(-3.0, 700.0);
    time("at", 300, || {
        std::hint::black_box(r.at(s));
    });
    time("condensed", 300, || {
        std::hint::black_box(r.condensed(s));
    });
    let x: Vec<Complex> = (0..24).map(|k| Complex::new(1.0, k as f64)).collect();
    let a = r.at(s).unwrap();
    time("response", 300, || {
        std::hint::black_box(a.response(&x));
    });
    let q = r.condensed(s);
    time("motion", 300, || {
        std::hint::black_box(q.motion(&x));
    });
    time("slope_times", 300, || {
        std::hint::black_box(q.slope_times(&x));
    });
    time("modes 12", 5, || {
        std::hint::black_box(r.modes(12).unwrap());
    });
    let all = r.modes(12).unwrap();
    let r2 = rotor(410.0);
    time("near 12", 5, || {
        for m in &all {
            std::hint::black_box(r2.near(m).unwrap());
        }
    });
    time("gradient", 100, || {
        std::hint::black_box(r.gradient(&all[0].left, &all[0].right, all[0].s));
    });
}
