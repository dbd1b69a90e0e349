"""Conjunctions of satellites: who comes near whom within a day, with nothing missed.

    conjunctions.py [catalogue.tle[.gz]] [--distance KM] [--hours H] [--every N] [--threads N]
                    [--table FILE.csv] [--cdm FOLDER]

python3-sgp4 propagates the element sets, and polynomials are fitted to its positions. PolynomialPaths finds all
approaches of the polynomials. Without a catalogue the script makes a few elements of its own. --cdm writes a
Conjunction Data Message (CCSDS 508.0-B-1, KVN) for each of the ten nearest.
"""

import argparse
import gzip
import sys
import time
from datetime import datetime, timedelta, timezone
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

import kinesphere as ks

try:
    from sgp4.api import WGS72, Satrec
except ImportError:
    print("conjunctions: needs sgp4 (Debian: python3-sgp4; PyPI: sgp4), which is not installed")
    sys.exit(0)

Doubles = npt.NDArray[np.float64]

terms = 12
arc_angle = 0.65
"""Longest arc in radians of the orbit at its perigee. Twelve terms fit that to 7e-5 km at worst."""
fit_error = 1e-3
"""Declared error of the fit in km. It covers also SGP4's jumps of centimetres at multiples of 720 minutes from
the epoch, where arcs are cut. How well SGP4 knows where a satellite is, is another matter: kilometres a day."""
resonance_step = 720 * 60.0
day = 86400.0

angles = np.pi * (np.arange(terms) + 0.5) / terms
nodes = np.cos(angles)
of_values = np.cos(np.outer(np.arange(terms), angles)) * (2.0 / terms)
of_values[0] /= 2.0
"""Chebyshev coefficients from the values at the nodes."""


def read(path: Path) -> list[Any]:
    lines = (gzip.open(path, "rt") if path.suffix == ".gz" else open(path)).read().splitlines()
    return [Satrec.twoline2rv(a, b) for a, b in zip(lines, lines[1:]) if a[:2] == "1 " and b[:2] == "2 "]


def invented() -> list[Any]:
    """Two planes of ten satellites that pass each other where the planes cross, and one on an eccentric orbit."""
    satellites = []
    for k in range(21):
        satellite, plane = Satrec(), k // 10
        eccentricity, revolutions = (0.001, 15.0) if plane < 2 else (0.7, 2.3)
        anomaly = np.radians(36.0) * (k % 10) - 0.39 * plane
        satellite.sgp4init(
            WGS72, "i", k + 1, 27000.5, 1e-5, 0.0, 0.0, eccentricity, 0.5, 1.2,
            anomaly, revolutions * 2 * np.pi / 1440, 1.0 + plane)  # fmt: skip
        satellites.append(satellite)
    return satellites


def start_of(satellites: list[Any]) -> tuple[float, float]:
    """The time to which 99 of 100 elements have their epochs: a few are dated ahead."""
    epochs = np.array([one.jdsatepoch + one.jdsatepochF for one in satellites])
    first = float(np.quantile(epochs, 0.99, method="lower"))
    return np.floor(first - 0.5) + 0.5, (first - 0.5) % 1.0


def borders(satellite: Any, start: tuple[float, float], seconds: float) -> Doubles:
    """Times between arcs."""
    e = satellite.ecco
    longest = arc_angle / (satellite.no_kozai / 60 * (1 + e) ** 2 / (1 - e * e) ** 1.5)
    epoch = ((satellite.jdsatepoch - start[0]) + (satellite.jdsatepochF - start[1])) * day
    steps = np.arange(np.ceil(-epoch / resonance_step), np.floor((seconds - epoch) / resonance_step) + 1)
    cuts = epoch + steps * resonance_step
    cuts = np.concatenate([[0.0], cuts[(cuts > 1.0) & (cuts < seconds - 1.0)], [seconds]])
    between = [np.linspace(a, b, int(np.ceil((b - a) / longest)) + 1)[:-1] for a, b in zip(cuts, cuts[1:])]
    return np.concatenate([*between, [seconds]])


def fit(satellites: list[Any], seconds: float, start: tuple[float, float]) -> ks.PolynomialPaths:
    """Paths in km over seconds. A body ends where SGP4 fails, or where its orbit is none that can be fitted."""
    all_borders = [borders(one, start, seconds) for one in satellites]
    count = sum(len(one) - 1 for one in all_borders)
    bodies, begins, ends = np.zeros(count, np.uint32), np.zeros(count), np.zeros(count)
    coefficients = np.zeros((count, 3, terms))
    filled = 0
    for number, (satellite, t) in enumerate(zip(satellites, all_borders)):
        times = (t[:-1, None] + t[1:, None]) / 2 + np.diff(t)[:, None] / 2 * nodes
        fractions = start[1] + times.ravel() / day
        errors, positions, _ = satellite.sgp4_array(np.full(len(fractions), start[0]), fractions)
        c = np.einsum("kn,anx->axk", of_values, positions.reshape(-1, terms, 3))
        is_bad = (errors.reshape(-1, terms) != 0).any(axis=1) | ~(np.abs(c[:, :, -1]) < fit_error / 2).all(
            axis=1
        )
        good = int(np.argmax(is_bad)) if is_bad.any() else len(is_bad)
        rows = slice(filled, filled + good)
        bodies[rows], begins[rows], ends[rows], coefficients[rows] = (
            number,
            t[:good],
            t[1 : good + 1],
            c[:good],
        )
        filled += good
    print(f"{len(satellites)} objects, {len(np.unique(bodies[:filled]))} of them propagated, {filled} arcs")
    return ks.PolynomialPaths(
        bodies[:filled],
        begins[:filled],
        ends[:filled],
        coefficients[:filled],
        errors=np.full(len(satellites), fit_error),
    )


def date_of(start: tuple[float, float], seconds: float) -> str:
    at = datetime(2000, 1, 1, 12, tzinfo=timezone.utc) + timedelta(
        days=start[0] - 2451545.0 + start[1], seconds=seconds
    )
    return at.strftime("%Y-%m-%dT%H:%M:%S.%f")[:-3]


def about_z(angle: float) -> Doubles:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])


def about_y(angle: float) -> Doubles:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def to_j2000(start: tuple[float, float], seconds: float) -> Doubles:
    """The matrix from SGP4's frame to EME2000 by precession (IAU 1976). Nutation and the equation of the equinoxes,
    20 arcseconds at most, are left out."""
    t = (start[0] + start[1] + seconds / day - 2451545.0) / 36525.0
    seconds_of_arc = np.array(
        [2306.2181 * t + 0.30188 * t**2, 2004.3109 * t - 0.42665 * t**2, 2306.2181 * t + 1.09468 * t**2])  # fmt: skip
    zeta, theta, z = np.radians(seconds_of_arc / 3600)
    matrix: Doubles = about_z(zeta) @ about_y(theta) @ about_z(z)
    return matrix


def designator_of(satellite: Any) -> str:
    """1998-067A for 98067A."""
    text = (getattr(satellite, "intldesg", None) or "").strip()  # none where the elements were invented
    if len(text) < 6 or not text[:5].isdigit():
        return "UNKNOWN"
    return f"{'19' if int(text[:2]) >= 57 else '20'}{text[:2]}-{text[2:]}"


def cdm(minimum: Any, satellites: list[Any], start: tuple[float, float]) -> str:
    """A message in KVN. The covariance is a placeholder of (1 km)^2 and (1 m/s)^2, as element sets have none."""
    turned = to_j2000(start, minimum["time"])
    first, second = (satellites[minimum[name]] for name in ("first", "second"))
    r, v = minimum["relative_position_rtn"] * 1000, minimum["relative_velocity_rtn"] * 1000
    lines = [
        "CCSDS_CDM_VERS = 1.0",
        f"CREATION_DATE = {datetime.now(timezone.utc):%Y-%m-%dT%H:%M:%S}",
        "ORIGINATOR = KINESPHERE_EXAMPLE",
        f"MESSAGE_ID = {first.satnum}_{second.satnum}_{int(minimum['time'] * 1000)}",
        f"TCA = {date_of(start, minimum['time'])}",
        f"MISS_DISTANCE = {minimum['distance'] * 1000:.3f} [m]",
        f"RELATIVE_SPEED = {minimum['relative_speed'] * 1000:.3f} [m/s]",
        *(f"RELATIVE_POSITION_{axis} = {x:.3f} [m]" for axis, x in zip("RTN", r)),
        *(f"RELATIVE_VELOCITY_{axis} = {x:.3f} [m/s]" for axis, x in zip("RTN", v)),
    ]
    for number, (satellite, name) in enumerate([(first, "first"), (second, "second")], 1):
        lines += [
            f"OBJECT = OBJECT{number}",
            f"OBJECT_DESIGNATOR = {satellite.satnum:05d}",
            "CATALOG_NAME = SATCAT",
            f"OBJECT_NAME = {satellite.satnum:05d}",
            f"INTERNATIONAL_DESIGNATOR = {designator_of(satellite)}",
            "EPHEMERIS_NAME = NONE",
            "COVARIANCE_METHOD = DEFAULT",
            "MANEUVERABLE = N/A",
            "REF_FRAME = EME2000",
            *(f"{a} = {x:.6f} [km]" for a, x in zip("XYZ", turned @ minimum[f"{name}_position"])),
            *(f"{a}_DOT = {x:.9f} [km/s]" for a, x in zip("XYZ", turned @ minimum[f"{name}_velocity"])),
        ]
        units = {0: "m**2", 1: "m**2/s", 2: "m**2/s**2"}
        axes = ["R", "T", "N", "RDOT", "TDOT", "NDOT"]
        for i, a in enumerate(axes):
            for k, b in enumerate(axes[: i + 1]):
                value = (1e6 if i < 3 else 1.0) if i == k else 0.0
                lines.append(f"C{a}_{b} = {value:.1f} [{units[(i > 2) + (k > 2)]}]")
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("catalogue", nargs="?", type=Path)
    parser.add_argument("--distance", type=float, default=5.0, help="km")
    parser.add_argument("--hours", type=float, default=24.0)
    parser.add_argument("--every", type=int, default=1, help="take each N-th object")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--table", type=Path)
    parser.add_argument("--cdm", type=Path)
    options = parser.parse_args()

    satellites = (read(options.catalogue) if options.catalogue else invented())[:: options.every]
    start = start_of(satellites)
    begun = time.process_time()
    paths = fit(satellites, options.hours * 3600, start)
    fitted = time.process_time()
    found = paths.approaches(options.distance, threads=options.threads)
    cost = (time.process_time() - fitted) * 1000 / (len(satellites) * options.hours / 24)
    minima = found.minima
    print(
        f"from {date_of(start, 0)}: {len(found)} approaches within {options.distance:g} km, {len(minima)} minima; "
        f"fits by sgp4 {fitted - begun:.1f} s, search {cost:.3f} ms for an object and day (steps of {found.step:.0f} s)"
    )
    nearest = minima[np.argsort(minima["distance"], kind="stable")[:10]]
    print(
        "  first  second  time                     distance km  speed km/s  radial, in-track, cross-track km"
    )
    for row in nearest:
        names = [satellites[row[name]].satnum for name in ("first", "second")]
        parts = "  ".join(f"{x:7.3f}" for x in row["relative_position_rtn"])
        print(
            f"{names[0]:7} {names[1]:7}  {date_of(start, row['time'])}  {row['distance']:11.4f}  {row['relative_speed']:10.3f}  {parts}"
        )
    if options.table:
        numbers = np.array([one.satnum for one in satellites])
        columns = ["time", "distance", "relative_speed"]
        table = np.column_stack(
            [numbers[minima["first"]], numbers[minima["second"]], *(minima[name] for name in columns),
             minima["relative_position_rtn"], minima["relative_velocity_rtn"]])  # fmt: skip
        header = "first,second,seconds,distance_km,speed_km_s,radial_km,in_track_km,cross_track_km,radial_km_s,in_track_km_s,cross_track_km_s"
        np.savetxt(options.table, table, "%.10g", ",", header=header, comments="")
    if options.cdm:
        options.cdm.mkdir(parents=True, exist_ok=True)
        for k, row in enumerate(nearest):
            (options.cdm / f"conjunction_{k}.cdm").write_text(cdm(row, satellites, start))


if __name__ == "__main__":
    main()
