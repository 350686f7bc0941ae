// The search of the site, in the page itself. A page that is opened as a file may start no worker and fetch no other file, so
// that tools/docs/site puts lunr, the pages' texts (site_texts) and this into one script.
(function () {
  const texts = new Map(site_texts.map((text) => [text.location, text]));
  const index = lunr(function () {
    this.ref("location");
    this.field("title", {boost: 10});
    this.field("text");
    site_texts.forEach((text) => this.add(text));
  });

  /** The best places for some words, of which each may be the beginning of one. */
  function find(words) {
    const found = index.query((query) =>
      lunr.tokenizer(words).forEach((token) => {
        query.term(lunr.stemmer(token), {boost: 10});
        query.term(token.toString(), {wildcard: lunr.Query.wildcard.TRAILING});
      }));
    return found.slice(0, 30).map((hit) => texts.get(hit.ref));
  }

  /** Puts the places found for the words of the box into the dialog. */
  function show() {
    const list = document.getElementById("mkdocs-search-results");
    const words = document.getElementById("mkdocs-search-query").value.trim();
    const places = words.length > 1 ? find(words) : [];
    list.replaceChildren(...places.map((place) => {
      const article = document.createElement("article");
      const link = article.appendChild(document.createElement("h3")).appendChild(document.createElement("a"));
      link.href = base_url.replace(/\/?$/, "/") + place.location;
      link.textContent = place.title;
      article.appendChild(document.createElement("p")).textContent = place.text.slice(0, 200);
      return article;
    }));
    if (words.length > 1 && !places.length) list.textContent = "Nothing found";
  }

  document.getElementById("mkdocs-search-query").addEventListener("input", show);
})();
