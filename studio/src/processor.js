// The script of helpers on the processor: one thread of WebAssembly each.

import * as ort from "onnxruntime-web/wasm";

import { help } from "./helper.js";

help(ort);
