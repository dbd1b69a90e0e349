// Many spheres, each a square facing the eye on which the sphere is computed for each pixel: round at any size, and
// cheap enough for thousands.
import {
  BufferAttribute, Color, CustomBlending, DynamicDrawUsage, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry,
  Mesh, OneFactor, ShaderMaterial, Vector3, ZeroFactor,
} from "three";

const vertices = `
  in vec4 ball;
  in vec3 tint;
  out vec3 place;
  out vec3 centre;
  out vec3 colour;
  flat out float radius;
  void main() {
    colour = tint;
    radius = ball.w;
    centre = (modelViewMatrix * vec4(ball.xyz, 1.0)).xyz;
    float away = length(centre);
    vec3 ahead = centre / away;
    vec3 right = normalize(cross(ahead, vec3(0.0, 1.0, 0.0)));
    vec3 up = cross(right, ahead);
    // The apparent size of the sphere in perspective, and a little more for the soft rim.
    float size = 1.03 * radius * away / sqrt(max(away * away - radius * radius, 1e-3 * away * away));
    place = centre + size * (position.x * right + position.y * up);
    gl_Position = projectionMatrix * vec4(place, 1.0);
  }`;

const fragments = `
  in vec3 place;
  in vec3 centre;
  in vec3 colour;
  flat in float radius;
  out vec4 fragment;
  uniform mat4 projectionMatrix;
  uniform vec3 sun;
  uniform vec3 sky;
  uniform vec3 mist;
  uniform vec2 mistRange;
  uniform float light;
  uniform float veil;
  // The transfer function of sRGB.
  vec3 encoded(vec3 c) {
    return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
  }
  void main() {
    vec3 ray = normalize(place);
    float along = dot(ray, centre);
    float aside = length(centre - along * ray);
    float rim = (radius - aside) / max(fwidth(aside), 1e-9);
    float cover = clamp(rim + 0.5, 0.0, 1.0);
    if (cover <= 0.0) discard;
    float half_ = sqrt(max(radius * radius - aside * aside, 0.0));
    vec3 hit = (along - half_) * ray;
    vec3 normal = normalize(hit - centre);
    vec4 clip = projectionMatrix * vec4(hit, 1.0);
    gl_FragDepth = clamp(0.5 * clip.z / clip.w + 0.5, 0.0, 1.0);
    float facing = max(dot(normal, -ray), 0.0);
    if (veil > 0.0) {
      fragment = vec4(encoded(colour), cover * veil * (0.25 + 1.5 * pow(1.0 - facing, 2.5)));
      return;
    }
    float above = 0.5 + 0.5 * dot(normal, sky);
    float lit = max(dot(normal, sun), 0.0);
    vec3 shade = colour * light * (mix(vec3(0.13, 0.15, 0.24), vec3(0.52), above) + 0.62 * lit);
    float shine = pow(max(dot(normal, normalize(sun - ray)), 0.0), 48.0);
    shade += 0.16 * shine + 0.05 * pow(1.0 - facing, 3.0);
    float fog = smoothstep(mistRange.x, mistRange.y, -hit.z);
    fragment = vec4(encoded(clamp(mix(shade, mist, fog), 0.0, 1.0)), cover);
  }`;

/** Where the light comes from, in the eye's frame. */
export const sunDirection = new Vector3(-0.4, 0.75, 0.53).normalize();

export class Spheres {
  readonly object: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  private balls = new InstancedBufferAttribute(new Float32Array(0), 4);
  private tints = new InstancedBufferAttribute(new Float32Array(0), 3);

  /** With a veil, a number up to 1, spheres are translucent and brighter at the rim. */
  constructor(veil = 0) {
    this.object = new Mesh(new InstancedBufferGeometry(), new ShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: vertices,
      fragmentShader: fragments,
      transparent: veil > 0,
      depthWrite: veil === 0,
      alphaToCoverage: veil === 0,
      // Alpha is the covered part of a pixel; in the picture it stays 1, or the page would shine through.
      ...(veil > 0 ? {} : {
        blending: CustomBlending, blendSrc: OneFactor, blendDst: ZeroFactor, blendSrcAlpha: OneFactor, blendDstAlpha: OneFactor,
      }),
      uniforms: {
        sun: { value: sunDirection },
        sky: { value: new Vector3(0, 1, 0) },
        mist: { value: new Color() },
        mistRange: { value: [1, 2] },
        light: { value: 1 },
        veil: { value: veil },
      },
    }));
    this.object.frustumCulled = false;
    this.object.renderOrder = veil > 0 ? 1 : 0;
  }

  /** Makes room for `count` spheres. */
  resize(count: number): void {
    if (this.balls.count === count) return;
    this.object.geometry.dispose();
    this.balls = new InstancedBufferAttribute(new Float32Array(4 * count), 4).setUsage(DynamicDrawUsage) as InstancedBufferAttribute;
    this.tints = new InstancedBufferAttribute(new Float32Array(3 * count), 3).setUsage(DynamicDrawUsage) as InstancedBufferAttribute;
    const geometry = new InstancedBufferGeometry();
    geometry.instanceCount = count;
    geometry.setAttribute("position", new BufferAttribute(new Float32Array([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]), 3));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    geometry.setAttribute("ball", this.balls);
    geometry.setAttribute("tint", this.tints);
    this.object.geometry = geometry;
  }
  put(k: number, x: number, y: number, z: number, radius: number, colour: Color): void {
    this.balls.setXYZW(k, x, y, z, radius);
    this.tints.setXYZ(k, colour.r, colour.g, colour.b);
  }
  hide(k: number): void {
    this.balls.setXYZW(k, 0, 0, 0, 0);
  }
  done(): void {
    this.balls.needsUpdate = true;
    this.tints.needsUpdate = true;
    this.object.visible = this.balls.count > 0;
  }
  /** `sky` is the upward direction in the eye's frame. */
  light(sky: Vector3, mist: Color, from: number, to: number, strength: number): void {
    const { uniforms } = this.object.material;
    uniforms["sky"]!.value.copy(sky);
    uniforms["mist"]!.value.copy(mist);
    uniforms["mistRange"]!.value = [from, to];
    uniforms["light"]!.value = strength;
  }
}
