import { readFileSync } from "node:fs";
import { defineConfig } from "vitest/config";
import { dependencies } from "./package.json";

// Names stay from build to build: the program that serves the page has them in itself.
const names = { entryFileNames: "assets/[name].js", chunkFileNames: "assets/[name].js", assetFileNames: "assets/[name][extname]" };

// The notices of what becomes part of the page, which its licenses ask for.
const notices = {
  name: "notices",
  generateBundle(this: { emitFile(file: { type: "asset"; fileName: string; source: string }): void }) {
    const text = (library: string) => `${library}\n\n${readFileSync(`node_modules/${library}/LICENSE`, "utf8")}`;
    this.emitFile({ type: "asset", fileName: "licenses.txt", source: Object.keys(dependencies).map(text).join("\n\n") });
  },
};

// The page is plain files with relative addresses, for any folder of any server.
export default defineConfig({
  base: "./",
  plugins: [notices],
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
