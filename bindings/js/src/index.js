// tact for JavaScript: finds where many deformable bodies touch.
import { SharedArray, TactError, library, ready, stringAt } from "./memory.js";
import { nearestRotation, rotationOfQuaternion, weld } from "./solver.js";
import { World } from "./world.js";

/** The version of tact. */
const version = () => stringAt(library().tact_version());
export { SharedArray, TactError, World, nearestRotation, ready, rotationOfQuaternion, version, weld };
