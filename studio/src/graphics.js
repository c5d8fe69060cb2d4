// The script of the helper on a graphics card: WebGPU.

import * as ort from "onnxruntime-web/webgpu";

import { help } from "./helper.js";

help(ort, true);
