// The module that ../../coast.js makes.
declare module "virtual:coast" {
  /** Address of the packed rings. */
  export const address: string;
  /** Positions are multiples of this. Unit: degrees. */
  export const step: number;
}
