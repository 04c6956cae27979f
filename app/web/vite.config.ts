import { defineConfig } from "vitest/config";

// The page is plain files with relative addresses, for any folder of any server.
export default defineConfig({
  base: "./",
  build: { outDir: "build", assetsInlineLimit: 0, modulePreload: { polyfill: false } },
  worker: { format: "es" },
  test: { testTimeout: 120_000, hookTimeout: 60_000 },
});
