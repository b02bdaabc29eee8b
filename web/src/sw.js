// Keeps the page for use without a network. Its files belong together: a new version takes the place of all of them, once no page of the old one is open.
const OURS = `planar-impact ${self.registration.scope} `;
const CACHE = `${OURS}__VERSION__`;
const FILES = "__FILES__";

self.addEventListener("install", (event) => {
  // Each from its host: what the browser has kept may be of another version.
  const fresh = FILES.map((file) => new Request(file, { cache: "reload" }));
  event.waitUntil(caches.open(CACHE).then((cache) => cache.addAll(fresh)));
});

self.addEventListener("activate", (event) => {
  const others = (names) => names.filter((name) => name.startsWith(OURS) && name !== CACHE);
  event.waitUntil(caches.keys().then((names) => Promise.all(others(names).map((name) => caches.delete(name)))).then(() => self.clients.claim()));
});

self.addEventListener("fetch", (event) => {
  if (event.request.method !== "GET") return;
  event.respondWith(caches.match(event.request, { cacheName: CACHE, ignoreSearch: true }).then((kept) => kept ?? fetch(event.request)));
});
