// Longitudes and latitudes on the plane of a watch: metres east and north of its origin, along the ellipsoid (WGS 84).
const equatorialRadius = 6_378_137;
const eccentricity2 = 6.69437999014e-3;
const radian = Math.PI / 180;

function cartesian(longitude: number, latitude: number): [number, number, number] {
  const [lambda, phi] = [longitude * radian, latitude * radian];
  const normal = equatorialRadius / Math.sqrt(1 - eccentricity2 * Math.sin(phi) ** 2);
  return [normal * Math.cos(phi) * Math.cos(lambda), normal * Math.cos(phi) * Math.sin(lambda), normal * (1 - eccentricity2) * Math.sin(phi)];
}

/** For drawing: its error within 500 km of the origin is some metres. */
export class EarthPlane {
  private readonly origin: readonly [number, number, number];
  private readonly meridional: number;
  private readonly normal: number;

  constructor(readonly longitude: number, readonly latitude: number) {
    this.origin = cartesian(longitude, latitude);
    const w = 1 - eccentricity2 * Math.sin(latitude * radian) ** 2;
    this.meridional = equatorialRadius * (1 - eccentricity2) / w ** 1.5;
    this.normal = equatorialRadius / Math.sqrt(w);
  }

  toPlane(longitude: number, latitude: number): [number, number] {
    const at = cartesian(longitude, latitude);
    const [dx, dy, dz] = [at[0] - this.origin[0], at[1] - this.origin[1], at[2] - this.origin[2]];
    const [lambda, phi] = [this.longitude * radian, this.latitude * radian];
    const outward = Math.cos(lambda) * dx + Math.sin(lambda) * dy;
    const east = Math.cos(lambda) * dy - Math.sin(lambda) * dx;
    const north = Math.cos(phi) * dz - Math.sin(phi) * outward;
    const flat = Math.hypot(east, north);
    if (flat === 0) return [0, 0];
    // The length of the arc over the chord, with the radius of curvature in this direction.
    const radius = 1 / ((east / flat) ** 2 / this.normal + (north / flat) ** 2 / this.meridional);
    const arc = 2 * radius * Math.asin(Math.min(Math.hypot(dx, dy, dz) / (2 * radius), 1));
    return [arc * east / flat, arc * north / flat];
  }

  /** Returns longitude and latitude. */
  toEarth(x: number, y: number): [number, number] {
    const phi = this.latitude * radian;
    const distance = Math.hypot(x, y);
    if (distance === 0) return [this.longitude, this.latitude];
    // The first approximation is on a sphere.
    const arc = Math.min(distance / this.normal, Math.PI);
    const [cos, sin] = [Math.cos(arc), Math.sin(arc)];
    let latitude = Math.asin(Math.max(-1, Math.min(1, cos * Math.sin(phi) + (y / distance) * sin * Math.cos(phi)))) / radian;
    let longitude = this.longitude +
      Math.atan2(x * sin, distance * Math.cos(phi) * cos - y * Math.sin(phi) * sin) / radian;
    for (let k = 0; k < 4; ++k) {
      const [foundX, foundY] = this.toPlane(longitude, latitude);
      const [dx, dy] = [x - foundX, y - foundY];
      latitude = Math.max(-90, Math.min(90, latitude + dy / this.meridional / radian));
      longitude += dx / (this.normal * Math.max(Math.cos(latitude * radian), 0.02)) / radian;
    }
    return [longitude, latitude];
  }
}
