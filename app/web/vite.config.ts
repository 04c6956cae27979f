import { defineConfig } from "vitest/config";

// Names stay from build to build: the program that serves the page has them in itself.
const names = { entryFileNames: "assets/[name].js", chunkFileNames: "assets/[name].js", assetFileNames: "assets/[name][extname]" };

// The page is plain files with relative addresses, for any folder of any server.
export default defineConfig({
  base: "./",
  build: {
    outDir: "site",
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 1000,
    rolldownOptions: { output: names },
  },
  worker: { format: "es", rolldownOptions: { output: names } },
  test: { testTimeout: 120_000, hookTimeout: 60_000 },
});
