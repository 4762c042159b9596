import { defineConfig } from "vite";

export default defineConfig({
  base: "/",
  build: {
    target: "es2022",
    assetsInlineLimit: 0, // data: URLs are against the page's own policy
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 1000,
    rollupOptions: { output: { assetFileNames: "[name][extname]", entryFileNames: "[name].js" } },
  },
});
