import { defineConfig } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";
import { fill } from "./scripts/fill.mjs";
import { makeSample } from "./scripts/sample.mjs";

// In `npm run dev` the page shows the sample; the built template keeps its data block empty for koshi to fill.
const sampleWhileServing = {
  name: "sample-while-serving",
  apply: "serve",
  transformIndexHtml: (html) => fill(html, makeSample()),
};

export default defineConfig({
  base: "./",
  plugins: [sampleWhileServing, viteSingleFile({ removeViteModuleLoader: true })],
  build: {
    outDir: process.env.KOSHI_REPORT_OUT ?? "dist",
    emptyOutDir: true,
    chunkSizeWarningLimit: 4000,
    reportCompressedSize: false,
    rollupOptions: { input: "report.html" },
  },
  server: { open: "/report.html" },
});
