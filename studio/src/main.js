// One classic script for both: the page starts workers from its own text, so that it needs no
// second file and works from a disk.

import { serve } from "./worker.js";
import { openPage } from "./page/page.js";

if (typeof document === "undefined") serve(self);
else openPage();
