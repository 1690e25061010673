// Checks proofs about linear complementarity problems. Written from docs/proofs.md alone; calculates with BigInt.
//
//     node lcpcheck.js PROBLEM PROOF    prints what it proves, or why it is refused
//     node lcpcheck.js FOLDER           every *.proof.json of a folder, about the problem of its hash in another *.json
//
// In a page: lcpcheck(problemText, proofText) returns { holds, says }.
"use strict";

const lcpcheck = (() => {
  class Refused extends Error {}
  const need = (holds, reason) => { if (!holds) throw new Refused(reason); };

  // ---- JSON, in which no object has a key twice
  function read(text) {
    const value = JSON.parse(text);
    const open = [];
    const tokens = /"(?:[^"\\]|\\.)*"(\s*:)?|[{}\[\]]/g;
    for (const [token, colon] of text.matchAll(tokens)) {
      if (token === "{" || token === "[") open.push(new Set());
      else if (token === "}" || token === "]") open.pop();
      else if (colon !== undefined) {
        const key = JSON.parse(token.slice(0, token.length - colon.length));
        need(!open.at(-1).has(key), "a key twice");
        open.at(-1).add(key);
      }
    }
    return value;
  }
  const has = (object, key) => Object.prototype.hasOwnProperty.call(object, key);
  const isObject = (v) => typeof v === "object" && v !== null && !Array.isArray(v);
  const hasKeys = (v, keys) =>
    isObject(v) && Object.keys(v).length === keys.length && keys.every((key) => has(v, key));
  const number = (v) => {
    need(typeof v === "number" && Number.isFinite(v), "a number");
    return v + 0;
  };
  const list = (v, n) => {
    need(Array.isArray(v) && v.length === n, "a list of another length");
    return v;
  };
  const isRow = (v, n) => Number.isInteger(v) && v >= 0 && v < n;
  function integer(v) {
    need(typeof v === "string" && /^(0|-?[1-9a-f][0-9a-f]*)$/.test(v), "an integer");
    return v[0] === "-" ? -BigInt("0x" + v.slice(1)) : BigInt("0x" + v);
  }

  // ---- a binary64 as m 2^e
  function parts(v) {
    const view = new DataView(new ArrayBuffer(8));
    view.setFloat64(0, v);
    const bits = view.getBigUint64(0);
    const exponent = Number((bits >> 52n) & 2047n), fraction = bits & ((1n << 52n) - 1n);
    let m = exponent === 0 ? fraction : fraction | (1n << 52n), e = Math.max(exponent, 1) - 1075;
    if (m === 0n) return [0n, 0];
    while ((m & 1n) === 0n) { m >>= 1n; e += 1; }
    return [v < 0 ? -m : m, e];
  }
  // Integers and s: the numbers times 2^s.
  function whole(values) {
    const all = values.map(parts);
    const s = all.reduce((most, [, e]) => Math.max(most, -e), 0);
    return [all.map(([m, e]) => m << BigInt(e + s)), BigInt(s)];
  }
  const abs = (v) => (v < 0n ? -v : v);
  const max = (a, b) => (a > b ? a : b);

  // ---- SHA-256 (FIPS 180-4)
  function sha256(bytes) {
    const primes = [], isPrime = (n) => { for (let d = 2; d * d <= n; d++) if (n % d === 0) return false; return true; };
    for (let n = 2; primes.length < 64; n++) if (isPrime(n)) primes.push(n);
    // The first 32 bits of the fractional parts of roots, exactly: ⌊root · 2^32⌋ mod 2^32.
    const root = (n, k) => {
      const target = BigInt(n) << BigInt(32 * k);
      let low = 0n, high = 1n << 42n;
      while (high - low > 1n) {
        const middle = (low + high) >> 1n;
        if (middle ** BigInt(k) <= target) low = middle; else high = middle;
      }
      return Number(low & 0xffffffffn);
    };
    const K = primes.map((p) => root(p, 3)), H = primes.slice(0, 8).map((p) => root(p, 2));
    const length = (bytes.length + 9 + 63) & ~63, data = new Uint8Array(length), view = new DataView(data.buffer);
    data.set(bytes);
    data[bytes.length] = 128;
    view.setBigUint64(length - 8, BigInt(bytes.length) * 8n);
    const turn = (x, n) => (x >>> n) | (x << (32 - n)), w = new Int32Array(64);
    for (let block = 0; block < length; block += 64) {
      for (let t = 0; t < 16; t++) w[t] = view.getInt32(block + 4 * t);
      for (let t = 16; t < 64; t++) {
        const a = turn(w[t - 15], 7) ^ turn(w[t - 15], 18) ^ (w[t - 15] >>> 3);
        const b = turn(w[t - 2], 17) ^ turn(w[t - 2], 19) ^ (w[t - 2] >>> 10);
        w[t] = w[t - 16] + a + w[t - 7] + b;
      }
      let [a, b, c, d, e, f, g, h] = H;
      for (let t = 0; t < 64; t++) {
        const s1 = turn(e, 6) ^ turn(e, 11) ^ turn(e, 25), s0 = turn(a, 2) ^ turn(a, 13) ^ turn(a, 22);
        const one = (h + s1 + ((e & f) ^ (~e & g)) + K[t] + w[t]) | 0;
        const two = (s0 + ((a & b) ^ (a & c) ^ (b & c))) | 0;
        [h, g, f, e, d, c, b, a] = [g, f, e, (d + one) | 0, c, b, a, (one + two) | 0];
      }
      [a, b, c, d, e, f, g, h].forEach((v, k) => { H[k] = (H[k] + v) | 0; });
    }
    return H.map((v) => (v >>> 0).toString(16).padStart(8, "0")).join("");
  }

  // ---- the problem
  // Puts triplets into the rows of a matrix with so many columns, by rising column, without zeros.
  function place(triplets, rows, columns) {
    need(Array.isArray(triplets), "a list of triplets");
    const seen = new Set();
    for (const triplet of triplets) {
      const [i, j, v] = list(triplet, 3);
      need(isRow(i, rows.length) && isRow(j, columns) && !seen.has(i * columns + j), "a triplet");
      seen.add(i * columns + j);
      if (number(v) !== 0) rows[i].push([j, v]);
    }
    rows.forEach((row) => row.sort((p, q) => p[0] - q[0]));
    return rows;
  }
  const empty = (n) => Array.from({ length: n }, () => []);

  // The key motion: M, J, bias, compliance, u*.
  function bodies(data, n) {
    need(hasKeys(data, ["mass", "jacobian", "bias", "compliance", "target"]), "the keys of motion");
    need(Array.isArray(data.target), "u*");
    const target = data.target.map(number), k = target.length;
    const bias = list(data.bias, n).map(number), soft = list(data.compliance, n).map(number);
    need(soft.every((v) => v >= 0), "a negative compliance");
    const mass = place(data.mass, empty(k), k), jacobian = place(data.jacobian, empty(n), k);
    need(data.mass.every(([i, j]) => i <= j), "an entry below the diagonal");
    return { mass, jacobian, bias, soft, target };
  }

  function problem(data) {
    need(isObject(data) && Array.isArray(data.b) && isObject(data.A), "A and b");
    const b = data.b.map(number), n = b.length, rows = empty(n);
    if (has(data.A, "dense")) {
      list(data.A.dense, n).forEach((row, i) =>
        list(row, n).forEach((v, j) => { if (number(v) !== 0) rows[i].push([j, v]); }));
    } else {
      need(data.A.rows === n && data.A.cols === n, "A has another size");
      place(data.A.triplets, rows, n);
    }
    const vector = (key, other) => (has(data, key) ? list(data[key], n) : b.map((_, i) => other(i)));
    const owner = vector("friction_index", () => -1);
    need(owner.every(Number.isInteger), "friction_index");
    const bound = (v) => (v === "inf" ? Infinity : v === "-inf" ? -Infinity : number(v));
    const lo = vector("lo", (i) => (owner[i] < 0 ? 0 : "-inf")).map(bound), hi = vector("hi", () => "inf").map(bound);
    const mu = vector("mu", () => 0).map((v, i) => (owner[i] < 0 ? 0 : number(v)));
    const scale = has(data, "scale") ? number(data.scale) : 0;
    need(scale > 0 || !has(data, "scale"), "scale");
    need(has(data, "mu") || owner.every((k) => k < 0), "mu");
    for (let i = 0; i < n; i++) {
      need(lo[i] <= hi[i] && lo[i] < Infinity && hi[i] > -Infinity, `the bounds of row ${i}`);
      const k = owner[i];
      if (k < 0) continue;
      need(k < n && owner[k] < 0 && lo[k] >= 0 && mu[i] >= 0, `the friction of row ${i}`);
      need(lo[i] === -Infinity && hi[i] === Infinity, `the bounds of row ${i}`);
    }
    const [values, sa] = whole(rows.flatMap((row) => row.map(([, v]) => v)));
    let next = 0;
    const A = rows.map((row) => row.map(([j]) => [j, values[next++]]));
    const [B, sb] = whole(b), [M, sm] = whole(mu);
    const [ends, sl] = whole([...lo, ...hi].map((v) => (Number.isFinite(v) ? v : 0)));
    const end = (k, v) => (Number.isFinite(v) ? ends[k] : null);
    const L = lo.map((v, i) => end(i, v)), U = hi.map((v, i) => end(n + i, v));

    const motion = has(data, "motion") ? bodies(data.motion, n) : null;
    const sizeOf = (matrix) => matrix.reduce((sum, row) => sum + 4 + 12 * row.length, 0);
    const size = 17 + 12 + sizeOf(rows) + 36 * n + 4 + (motion === null ? 0
      : 4 + sizeOf(motion.mass) + sizeOf(motion.jacobian) + 16 * n + 8 * motion.target.length);
    const bytes = new Uint8Array(size), view = new DataView(bytes.buffer);
    let at = 17;
    const put4 = (v) => { view.setUint32(at, v); at += 4; };
    const put8 = (v) => { view.setFloat64(at, v + 0); at += 8; };
    bytes.set(Array.from("lcplab problem 1\n", (c) => c.charCodeAt(0)));
    put4(n);
    put8(scale);
    const putRow = (row) => {
      put4(row.length);
      for (const [j, v] of row) { put4(j); put8(v); }
    };
    rows.forEach(putRow);
    for (const vector of [b, lo, hi]) vector.forEach(put8);
    owner.forEach((k, i) => { put4(k < 0 ? 0 : k + 1); put8(mu[i]); });
    put4(motion === null ? 0 : 1);
    if (motion !== null) {
      put4(motion.target.length);
      [motion.mass, motion.jacobian].forEach((matrix) => matrix.forEach(putRow));
      [motion.bias, motion.soft, motion.target].forEach((vector) => vector.forEach(put8));
    }
    return { n, A, B, M, L, U, owner, sa, sb, sl, sm, motion, least: parts(scale), hash: sha256(bytes) };
  }

  // x times D, and D, from a point of a proof.
  function point(p, data) {
    need(hasKeys(data, ["denominator", "numerators"]), "a point");
    const d = integer(data.denominator), given = list(data.numerators, p.n), x = Array(p.n).fill(0n);
    need(d > 0n, "a denominator");
    const first = [...x.keys()].filter((i) => p.owner[i] < 0), then = [...x.keys()].filter((i) => p.owner[i] >= 0);
    for (const i of [...first, ...then]) {
      const side = given[i];
      if (side !== "lo" && side !== "hi") x[i] = integer(side) << (p.sl + p.sm);
      else if (p.owner[i] < 0) {
        const bound = side === "lo" ? p.L[i] : p.U[i];
        need(bound !== null, `row ${i} has no such bound`);
        x[i] = (bound * d) << p.sm;
      } else {
        const reach = (p.M[i] * max(x[p.owner[i]], 0n)) >> p.sm;
        x[i] = side === "lo" ? -reach : reach;
      }
    }
    return [x, d << (p.sl + p.sm)];
  }

  function solution(p, data) {
    const [x, D] = point(p, data);
    p.A.forEach((row, i) => {
      const sum = row.reduce((sum, [j, a]) => sum + a * x[j], 0n);
      const w = (sum << p.sb) + ((p.B[i] * D) << p.sa), k = p.owner[i];
      const reach = k < 0 ? 0n : p.M[i] * max(x[k], 0n), own = x[i] << (k < 0 ? p.sl : p.sm);
      const lo = k >= 0 ? -reach : p.L[i] === null ? null : p.L[i] * D;
      const hi = k >= 0 ? reach : p.U[i] === null ? null : p.U[i] * D;
      need((lo === null || lo <= own) && (hi === null || own <= hi), `x of row ${i} is beyond a bound`);
      need((w <= 0n || own === lo) && (w >= 0n || own === hi), `w of row ${i} has the wrong sign`);
    });
    return [x, D];
  }

  // Whether all leading principal minors are positive: they are the pivots of Bareiss' elimination.
  function isPositive(m) {
    let last = 1n;
    for (let c = 0; c < m.length; c++) {
      const own = m[c], pivot = own[c];
      if (pivot <= 0n) return false;
      for (let r = c + 1; r < m.length; r++) {
        const f = m[r][c];
        for (let j = c; j < m.length; j++) m[r][j] = (m[r][j] * pivot - f * own[j]) / last;
      }
      last = pivot;
    }
    return true;
  }

  function unique(p, by) {
    need(p.owner.every((k) => k < 0), "rows are coupled");
    const full = p.A.map((row) => {
      const dense = Array(p.n).fill(0n);
      row.forEach(([j, a]) => { dense[j] = a; });
      return dense;
    });
    if (by === "definite") {
      need(p.n <= 500, "more than 500 rows");
      need(isPositive(full.map((row, i) => row.map((a, j) => a + full[j][i]))), "A + A' is not positive definite");
      return;
    }
    need(by === "p-matrix" && p.n <= 12, "by");
    for (let size = 1; size <= p.n; size++) {
      for (let set = 1; set < 1 << p.n; set++) {
        const rows = [...full.keys()].filter((i) => (set >> i) & 1);
        if (rows.length === size) need(isPositive(rows.map((i) => rows.map((j) => full[i][j]))), "a minor");
      }
    }
  }

  function tree(p, data, sides) {
    need(isObject(data), "a tree");
    if (hasKeys(data, ["d"])) return leaf(p, data.d, sides);
    const i = data.row;
    need(isRow(i, p.n) && !sides.has(i), "a branch");
    const ways = ["free"];
    if (p.owner[i] >= 0 || p.L[i] !== null) ways.push("lo");
    if (p.owner[i] >= 0 || p.U[i] !== null) ways.push("hi");
    need(hasKeys(data, ["row", ...ways]), `the sides of row ${i}`);
    for (const side of ways) tree(p, data[side], new Map([...sides, [i, side]]));
  }

  function leaf(p, data, sides) {
    need(isObject(data), "a d");
    const c = Array(p.n).fill(0n);          // times 2^(sa + sm)
    let total = 0n;                         // times 2^(sa + sb + sl + sm)
    for (const [key, value] of Object.entries(data)) {
      need(/^(0|[1-9][0-9]*)$/.test(key) && Number(key) < p.n, "a row of d");
      const i = Number(key), d = integer(value), side = sides.get(i), isCoupled = p.owner[i] >= 0;
      const mayFall = side === "hi" || side === "free" || (side === undefined && !isCoupled && p.L[i] === null);
      const mayRise = side === "lo" || side === "free" || (side === undefined && !isCoupled && p.U[i] === null);
      need((d >= 0n || mayFall) && (d <= 0n || mayRise), `the sign of d in row ${i}`);
      for (const [j, a] of p.A[i]) c[j] += (a * d) << p.sm;
      total += (p.B[i] * d) << (p.sa + p.sl + p.sm);
    }
    p.owner.forEach((k, j) => {
      if (k < 0) return;
      const side = sides.get(j), own = side === "lo" ? -c[j] : side === "hi" ? c[j] : abs(c[j]);
      c[k] += (p.M[j] * own) >> p.sm;
    });
    p.owner.forEach((k, j) => {
      if (k >= 0 || c[j] === 0n) return;
      const side = sides.get(j), isUp = side === "hi" || (side !== "lo" && c[j] > 0n);
      const bound = isUp ? p.U[j] : p.L[j];
      need(bound !== null, `nothing bounds the product in row ${j}`);
      total += (c[j] * bound) << p.sb;
    });
    need(total < 0n, "the vector of a case shows nothing");
  }

  // ---- fractions [p, q] with q > 0
  const gcd = (a, b) => { a = abs(a); b = abs(b); while (b) [a, b] = [b, a % b]; return a; };
  const fraction = (p, q) => { const g = q < 0n ? -gcd(p, q) : gcd(p, q); return [p / g, q / g]; };
  const plus = (a, b) => fraction(a[0] * b[1] + b[0] * a[1], a[1] * b[1]);
  const times = (a, b) => fraction(a[0] * b[0], a[1] * b[1]);
  const over = (a, b) => fraction(a[0] * b[1], a[1] * b[0]);
  const negative = ([p, q]) => [-p, q], size = ([p, q]) => [abs(p), q];
  const less = (a, b) => a[0] * b[1] < b[0] * a[1];
  const larger = (a, b) => (less(a, b) ? b : a), smaller = (a, b) => (less(a, b) ? a : b);
  const binary = ([m, e]) => (e >= 0 ? [m << BigInt(e), 1n] : fraction(m, 1n << BigInt(-e)));

  // The scaled residual of an answer.
  function residual(p, answer) {
    const x = answer.map((v) => binary(parts(v))), zero = [0n, 1n], least = binary(p.least);
    const rows = p.A.map((row, i) => {
      const terms = [...row.map(([j, a]) => times(fraction(a, 1n << p.sa), x[j])), fraction(p.B[i], 1n << p.sb)];
      const own = row.find(([j]) => j === i), most = row.reduce((most, [, a]) => max(most, abs(a)), 0n);
      const s = fraction(own ? abs(own[1]) : most, 1n << p.sa);
      const ends = [p.L[i], p.U[i]].filter((v) => v !== null).reduce((most, v) => max(most, abs(v)), 0n);
      return {
        w: terms.reduce(plus, zero),
        T: larger(terms.map(size).reduce(plus, zero), times(s, least)),
        s: s[0] === 0n ? [1n, 1n] : s,
        R: ends === 0n ? null : larger(fraction(ends, 1n << p.sl), least),
      };
    });
    const unit = ({ T, s }, R) => (R === null ? over(T, s) : smaller(over(T, s), R));
    return rows.reduce((worst, row, i) => {
      const k = p.owner[i], end = (v) => (v === null ? null : fraction(v, 1n << p.sl));
      let own = x[i], [lo, hi, R] = [end(p.L[i]), end(p.U[i]), row.R];
      if (k >= 0) {
        const mu = fraction(p.M[i], 1n << p.sm);
        hi = times(mu, larger(x[k], zero));
        lo = negative(hi);
        const reach = times(mu, larger(x[k], unit(rows[k], rows[k].R)));
        R = reach[0] === 0n ? null : reach;
        const near = times(hi, [1n, 1n << 50n]);
        own = [lo, hi].find((v) => !less(near, size(plus(own, negative(v))))) ?? own;
      }
      const e = unit(row, R), step = row.T[0] === 0n ? zero : over(times(e, row.w), row.T);
      let target = plus(own, negative(step));
      if (lo !== null) target = larger(target, lo);
      if (hi !== null) target = smaller(target, hi);
      const miss = size(plus(own, negative(target)));
      need(e[0] > 0n || miss[0] === 0n, "the residual is not finite");
      return miss[0] === 0n ? worst : larger(worst, over(miss, e));
    }, zero);
  }

  // 2 (P + D) of an answer and a motion.
  function gap(p, answer, data) {
    const exact = (v) => binary(parts(v)), zero = [0n, 1n], minus = (a, b) => plus(a, negative(b));
    const { mass, jacobian, bias, soft, target } = p.motion, k = target.length, x = answer.map(exact);
    need(hasKeys(data, ["denominator", "numerators"]), "a motion");
    const D = integer(data.denominator);
    need(D > 0n, "a denominator");
    const v = list(data.numerators, k).map((N) => fraction(integer(N), D));
    const moved = v.map((v, j) => minus(v, exact(target[j]))), f = Array(k).fill(zero);
    const add = (j, term) => { f[j] = plus(f[j], term); };
    mass.forEach((row, i) => row.forEach(([j, m]) => {
      add(i, times(exact(m), moved[j]));
      if (i !== j) add(j, times(exact(m), moved[i]));
    }));
    let sum = zero;
    jacobian.forEach((row, i) => {
      let [lo, hi] = [p.L[i], p.U[i]].map((end) => (end === null ? null : fraction(end, 1n << p.sl)));
      if (p.owner[i] >= 0) {
        hi = times(fraction(p.M[i], 1n << p.sm), larger(x[p.owner[i]], zero));
        lo = negative(hi);
      }
      need((lo === null || !less(x[i], lo)) && (hi === null || !less(hi, x[i])), `the answer of row ${i} is beyond a bound`);
      const give = exact(soft[i]);
      const w = row.reduce((w, [j, a]) => plus(w, times(exact(a), v[j])), plus(exact(bias[i]), times(give, x[i])));
      const end = w[0] > 0n ? lo : hi, costs = [];
      if (end !== null) costs.push(size(times(minus(x[i], end), w)));
      if (give[0] > 0n) costs.push(over(times(w, w), times([2n, 1n], give)));
      need(costs.length > 0 || w[0] === 0n, `the motion breaks row ${i}`);
      if (w[0] !== 0n) sum = plus(sum, times([2n, 1n], costs.reduce(smaller)));
      row.forEach(([j, a]) => add(j, negative(times(exact(a), x[i]))));
    });
    // M = L D L'; f becomes its L^-1 f
    const left = mass.map((row) => new Map(row.map(([j, m]) => [j, exact(m)])));
    left.forEach((row, c) => {
      const pivot = row.get(c) ?? zero;
      need(pivot[0] > 0n, "the mass matrix is not positive definite");
      sum = plus(sum, over(times(f[c], f[c]), pivot));
      for (const [r, value] of row) {
        if (r === c) continue;
        const factor = over(value, pivot);
        add(r, negative(times(factor, f[c])));
        for (const [s, other] of row) {
          if (s >= r) left[r].set(s, minus(left[r].get(s) ?? zero, times(factor, other)));
        }
      }
    });
    return sum;
  }

  const KEYS = {
    "solution": [["x"], ["x", "answer", "distance"]], "unique": [["x", "by"]], "not-unique": [["x", "y"]],
    "no-solution": [["tree"]], "within": [["answer", "residual"]],
    "motion": [["answer", "motion", "bound"]], "frozen-motion": [["answer", "motion", "bound"]],
  };

  function check(p, proof) {
    need(isObject(proof) && proof.format === "lcplab-proof-1", "another format");
    const known = typeof proof.kind === "string" && has(KEYS, proof.kind) ? KEYS[proof.kind] : [];
    need(known.some((keys) => hasKeys(proof, ["format", "problem", "kind", ...keys])), "the keys of its kind");
    need(proof.problem === p.hash, "it is about another problem");
    const answer = has(proof, "answer") ? list(proof.answer, p.n).map(number) : null;
    if (proof.kind === "no-solution") {
      tree(p, proof.tree, new Map());
      return "no solution exists";
    }
    if (proof.kind === "within") {
      need(hasKeys(proof.residual, ["numerator", "denominator"]), "a fraction");
      const [r, s] = [integer(proof.residual.numerator), integer(proof.residual.denominator)];
      const own = residual(p, answer);
      need(s > 0n && r * own[1] === s * own[0], "the residual is another");
      return "the scaled residual of the answer is the fraction that it states";
    }
    if (proof.kind === "motion" || proof.kind === "frozen-motion") {
      const isFrozen = proof.kind !== "motion";
      need(isFrozen === p.owner.some((k) => k >= 0), "the kind for rows that are coupled is another");
      need(p.motion !== null, "the problem says nothing of bodies");
      const bound = binary(parts(number(proof.bound)));
      need(bound[0] >= 0n && !less(times(bound, bound), gap(p, answer, proof.motion)), "the motion shows a larger bound only");
      return `the motion of the answer is within ${proof.bound} of the exact one${isFrozen ? ", with frozen friction" : ""}`;
    }
    const [x, D] = solution(p, proof.x);
    if (proof.kind === "unique") {
      unique(p, proof.by);
      return "exactly one solution exists";
    }
    if (proof.kind === "not-unique") {
      const [y, E] = solution(p, proof.y);
      need(x.some((v, i) => v * E !== y[i] * D), "both solutions are one");
      return "two different solutions exist";
    }
    if (answer === null) return "a solution exists";
    const [values, s] = whole([number(proof.distance), ...answer]), [distance, ...near] = values;
    need(near.every((v, i) => abs(v * D - (x[i] << s)) <= distance * D), "the answer is farther away");
    return `a solution exists within ${proof.distance} of the answer`;
  }

  const checked = (p, proofText) => {
    try {
      return { holds: true, says: check(p, read(proofText)) };
    } catch (error) {
      return { holds: false, says: error.message };
    }
  };
  const lcpcheck = (problemText, proofText) => checked(problem(read(problemText)), proofText);
  // The same for many proofs: about the problem of its hash each.
  lcpcheck.all = (problemTexts, proofTexts) => {
    const problems = new Map(problemTexts.map((text) => problem(read(text))).map((p) => [p.hash, p]));
    const another = { holds: false, says: "it is about another problem" };
    const hash = (text) => { try { return JSON.parse(text).problem; } catch { return null; } };
    return proofTexts.map((text) => (problems.has(hash(text)) ? checked(problems.get(hash(text)), text) : another));
  };
  return lcpcheck;
})();

if (typeof process !== "undefined" && typeof require !== "undefined" && require.main === module) {
  const fs = require("fs"), path = require("path"), given = process.argv.slice(2);
  const names = given.length === 1 ? fs.readdirSync(given[0]).sort().map((name) => path.join(given[0], name)) : null;
  const proofs = names === null ? [given[1]] : names.filter((name) => name.endsWith(".proof.json"));
  const problems = names === null ? [given[0]] : names.filter((name) => name.endsWith(".json") && !proofs.includes(name));
  const text = (name) => fs.readFileSync(name, "utf8");
  const found = lcpcheck.all(problems.map(text), proofs.map(text));
  found.forEach(({ holds, says }, k) => console.log(`${proofs[k]}: ${holds ? "proved" : "refused"}: ${says}`));
  process.exitCode = found.every(({ holds }) => holds) ? 0 : 1;
}
