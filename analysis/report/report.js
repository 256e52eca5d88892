// Behaviour of plenolab reports: theme, contents, sorting, image comparison. Pages work (less comfortably) without it.
(() => {
  'use strict';

  const element = (tag, attributes = {}, ...children) => {
    const node = document.createElement(tag);
    for (const [key, value] of Object.entries(attributes)) {
      if (key.startsWith('on')) node.addEventListener(key.slice(2), value);
      else node.setAttribute(key, value);
    }
    node.append(...children);
    return node;
  };

  // ---- Theme: as the system, or as chosen -------------------------------------------------------------------------
  const themes = ['system', 'light', 'dark'];
  const storage = {  // may be forbidden for local files
    get: () => { try { return localStorage.getItem('plenolab-theme'); } catch { return null; } },
    set: (value) => { try { localStorage.setItem('plenolab-theme', value); } catch { /* only for this visit then */ } },
  };
  function setupTheme() {
    const button = document.querySelector('.theme');
    const fromAddress = new URLSearchParams(location.search).get('theme');
    const apply = (theme) => {
      if (theme === 'system') delete document.documentElement.dataset.theme;
      else document.documentElement.dataset.theme = theme;
      button.textContent = { system: 'Theme: system', light: 'Theme: light', dark: 'Theme: dark' }[theme];
      button.dataset.current = theme;
    };
    const wanted = fromAddress || storage.get();
    apply(themes.includes(wanted) ? wanted : 'system');
    button.hidden = false;
    button.addEventListener('click', () => {
      const next = themes[(themes.indexOf(button.dataset.current) + 1) % themes.length];
      storage.set(next);
      apply(next);
    });
  }

  // ---- Table of contents: marks the section being read ----------------------------------------------------------
  function setupContents() {
    const links = [...document.querySelectorAll('.toc a')];
    const sections = links.map((link) => document.getElementById(decodeURIComponent(link.hash.slice(1))));
    const update = () => {
      let current = 0;
      sections.forEach((section, i) => { if (section && section.getBoundingClientRect().top < innerHeight * 0.3) current = i; });
      const atEnd = innerHeight + scrollY >= document.documentElement.scrollHeight - 4 && scrollY > 0;
      if (atEnd) current = sections.length - 1;
      links.forEach((link, i) => i === current ? link.setAttribute('aria-current', 'true') : link.removeAttribute('aria-current'));
    };
    addEventListener('scroll', update, { passive: true });
    addEventListener('resize', update);
    update();
  }

  // ---- Sortable tables --------------------------------------------------------------------------------------------
  const cellKey = (row, column) => {
    const cell = row.cells[column];
    if ('v' in cell.dataset) {
      const text = cell.dataset.v;
      return text === 'inf' ? Infinity : text === '-inf' ? -Infinity : Number(text);
    }
    return cell.textContent;
  };
  const compareKeys = (a, b) => {
    if (typeof a === 'number' && typeof b === 'number') return a === b ? 0 : a - b;
    if (typeof a === typeof b) return a.localeCompare(b, undefined, { numeric: true });
    return typeof a === 'number' ? -1 : 1;  // numbers before text and gaps
  };
  function setupTable(table) {
    const headings = [...table.tHead.rows[0].cells];
    headings.forEach((heading, column) => {
      const button = element('button', { type: 'button' }, heading.textContent);
      heading.replaceChildren(button);
      button.addEventListener('click', () => {
        const descending = heading.getAttribute('aria-sort') === 'ascending';
        headings.forEach((other) => other.removeAttribute('aria-sort'));
        heading.setAttribute('aria-sort', descending ? 'descending' : 'ascending');
        const rows = [...table.tBodies[0].rows];
        rows.sort((a, b) => (descending ? -1 : 1) * compareKeys(cellKey(a, column), cellKey(b, column)));
        table.tBodies[0].append(...rows);
      });
    });
  }

  // ---- Image comparison -------------------------------------------------------------------------------------------
  const MIN_SIDE = 220, MAX_ZOOM = 64, GRID_FROM = 20, CONTACT_WIDTH = 320, CONTACT_PANE = 300;

  class Comparison {
    constructor(figure, images) {
      this.figure = figure;
      this.images = images;
      this.labels = images.map((image) => image.dataset.label);
      this.width = images[0].naturalWidth;
      this.height = images[0].naturalHeight;
      this.contact = images.length > 2 && this.width <= CONTACT_WIDTH;  // a contact sheet: small, all at once
      this.mode = this.contact ? 'side' : images.length > 1 ? 'wipe' : 'flip';
      this.current = 0;
      this.previous = Math.min(1, images.length - 1);
      this.left = 0;
      this.right = Math.min(1, images.length - 1);
      this.divider = 0.5;   // share of the stage's width
      this.zoom = 0;        // CSS pixels per image pixel; 0 = fit
      this.centre = { x: this.width / 2, y: this.height / 2 };
      this.hover = null;
      this.values = images.map(() => null);  // pixels for the readout, fetched at first use
      this.build();
      this.listen();
      figure.classList.add('live');
      this.layout();
    }

    build() {
      const button = (label, title, action) => element('button', { type: 'button', title, onclick: action }, label);
      const modes = [['flip', 'Flip', 'F'], ['wipe', 'Wipe', 'W'], ['side', 'Side by side', 'S']];
      this.modeButtons = modes.map(([mode, label, key]) => {
        const node = button(label, `${label} (key ${key})`, () => this.setMode(mode));
        node.dataset.mode = mode;
        return node;
      });
      this.tabs = this.labels.map((label, i) => {
        const node = button('', `Show ${label} (key ${i + 1})`, () => this.show(i));
        if (i < 9) node.append(element('kbd', {}, String(i + 1)));
        node.append(label);
        return node;
      });
      const chooser = (name, change) => {
        const select = element('select', { 'aria-label': name, onchange: () => change(Number(select.value)) },
          ...this.labels.map((label, i) => element('option', { value: i }, label)));
        return select;
      };
      this.leftSelect = chooser('Left image', (i) => { this.left = i; this.refresh(); });
      this.rightSelect = chooser('Right image', (i) => { this.right = i; this.refresh(); });
      this.zoomText = button('', 'One image pixel per screen pixel (key =)', () => this.setZoom(1 / devicePixelRatio));
      this.tabGroup = element('div', { class: 'group', role: 'group', 'aria-label': 'Image' }, ...this.tabs);
      this.pairGroup = element('span', {}, this.leftSelect, ' | ', this.rightSelect);
      const bar = element('div', { class: 'bar' },
        element('div', { class: 'group', role: 'group', 'aria-label': 'Mode' }, ...this.modeButtons),
        this.tabGroup, this.pairGroup, element('span', { class: 'spacer' }),
        element('div', { class: 'group', role: 'group', 'aria-label': 'Zoom' },
          button('−', 'Zoom out (key −)', () => this.setZoom(this.scale() / 2)), this.zoomText,
          button('+', 'Zoom in (key +)', () => this.setZoom(this.scale() * 2)),
          button('Fit', 'Fit (key 0)', () => this.fit()),
          button('Full', 'Full screen', () => this.toggleFullscreen())));
      this.canvas = element('canvas', { tabindex: '0', role: 'img', 'aria-label': this.figure.dataset.alt +
        ' — keys: 1 to 9 choose the image, F W S the mode, plus and minus zoom, 0 fits, arrows move.' });
      this.status = element('div', { class: 'status' });
      this.box = this.figure.querySelector('.box');
      this.box.prepend(bar, this.canvas, this.status);
      this.context = this.canvas.getContext('2d');
    }

    // -- State
    setMode(mode) { this.mode = mode; this.layout(); }
    show(i) {
      if (i !== this.current) { this.previous = this.current; this.current = i; }
      if (this.mode === 'wipe') this.right = i; else if (this.mode === 'side') this.mode = 'flip';
      this.layout();
    }
    fit() { this.zoom = 0; this.centre = { x: this.width / 2, y: this.height / 2 }; this.refresh(); }
    toggleFullscreen() {
      if (document.fullscreenElement) document.exitFullscreen();
      else if (this.box.requestFullscreen) this.box.requestFullscreen();
    }

    // -- Geometry: panes in CSS pixels, all with the same view
    panes() {
      const { w, h } = this.stage;
      if (this.mode !== 'side') return [{ x: 0, y: 0, w, h, image: this.current }];
      const gap = 4, columns = this.columns, rows = Math.ceil(this.images.length / columns);
      const pw = (w - gap * (columns - 1)) / columns, ph = (h - gap * (rows - 1)) / rows;
      return this.images.map((_, i) => ({ x: (i % columns) * (pw + gap), y: Math.floor(i / columns) * (ph + gap), w: pw, h: ph, image: i }));
    }
    fitScale() { const p = this.panes()[0]; return Math.min(p.w / this.width, p.h / this.height); }
    scale() { return this.zoom || this.fitScale(); }
    clampCentre() {
      const p = this.panes()[0], s = this.scale();
      const clamp = (v, size, visible) => visible >= size ? size / 2 : Math.min(Math.max(v, visible / 2), size - visible / 2);
      this.centre.x = clamp(this.centre.x, this.width, p.w / s);
      this.centre.y = clamp(this.centre.y, this.height, p.h / s);
    }
    setZoom(zoom, anchor) {
      const before = this.scale(), fit = this.fitScale();
      const next = Math.min(Math.max(zoom, Math.min(fit, 1 / devicePixelRatio)), MAX_ZOOM);
      if (anchor) {  // keep the image point under the pointer where it is
        const p = anchor.pane, dx = anchor.x - p.x - p.w / 2, dy = anchor.y - p.y - p.h / 2;
        this.centre.x += dx / before - dx / next;
        this.centre.y += dy / before - dy / next;
      }
      this.zoom = Math.abs(next - fit) < 1e-6 ? 0 : next;
      this.refresh();
    }
    paneAt(x, y) { return this.panes().find((p) => x >= p.x && x < p.x + p.w && y >= p.y && y < p.y + p.h); }
    toImage(pane, x, y) {
      const s = this.scale();
      return { x: this.centre.x + (x - pane.x - pane.w / 2) / s, y: this.centre.y + (y - pane.y - pane.h / 2) / s };
    }

    layout() {
      const w = this.box.clientWidth, full = document.fullscreenElement === this.box;
      const most = full ? innerHeight - 100 : Math.max(MIN_SIDE, innerHeight * 0.78);
      this.columns = 1;
      let h = w * this.height / this.width;
      if (this.mode === 'side') {  // the number of columns that shows the images largest
        let best = 0;
        for (let columns = 1; columns <= this.images.length; ++columns) {
          const rows = Math.ceil(this.images.length / columns);
          const scale = Math.min(w / columns / this.width, most / rows / this.height);
          if (scale > best * 1.001) { best = scale; this.columns = columns; }
        }
        if (this.contact && !full) this.columns = Math.max(1, Math.min(this.images.length, Math.round(w / CONTACT_PANE)));
        h = w / this.columns * this.height / this.width * Math.ceil(this.images.length / this.columns);
      }
      h = full ? most : Math.max(MIN_SIDE, Math.min(h, most));
      this.stage = { w, h };
      this.canvas.style.height = `${h}px`;
      const ratio = devicePixelRatio || 1;
      this.canvas.width = Math.round(w * ratio);
      this.canvas.height = Math.round(h * ratio);
      this.refresh();
    }

    // -- Drawing
    refresh() {
      this.clampCentre();
      this.modeButtons.forEach((b) => b.setAttribute('aria-pressed', b.dataset.mode === this.mode));
      this.tabs.forEach((b, i) => b.setAttribute('aria-pressed', this.mode === 'flip' && i === this.current));
      this.tabGroup.hidden = this.mode === 'wipe';
      this.tabGroup.style.display = this.mode === 'wipe' ? 'none' : '';
      this.pairGroup.style.display = this.mode === 'wipe' ? '' : 'none';
      this.leftSelect.value = this.left;
      this.rightSelect.value = this.right;
      const percent = this.scale() * (devicePixelRatio || 1) * 100;
      this.zoomText.textContent = `${percent >= 10 ? Math.round(percent) : percent.toFixed(1)} %`;
      this.draw();
      this.report();
    }
    draw() {
      const c = this.context, ratio = this.canvas.width / this.stage.w;
      c.setTransform(ratio, 0, 0, ratio, 0, 0);
      c.clearRect(0, 0, this.stage.w, this.stage.h);
      if (this.mode === 'wipe') this.drawWipe();
      else for (const pane of this.panes()) { this.drawPane(pane, pane.image); this.drawLabel(pane, this.labels[pane.image], false); }
    }
    drawPane(pane, image, clip = pane) {
      const c = this.context, s = this.scale();
      const x = pane.x + pane.w / 2 - this.centre.x * s, y = pane.y + pane.h / 2 - this.centre.y * s;
      c.save();
      c.beginPath();
      c.rect(clip.x, clip.y, clip.w, clip.h);
      c.clip();
      c.imageSmoothingEnabled = s * (devicePixelRatio || 1) < 1;
      c.imageSmoothingQuality = 'high';
      c.drawImage(this.images[image], x, y, this.width * s, this.height * s);
      if (s >= GRID_FROM) this.drawGrid(pane, x, y, s);
      c.restore();
    }
    drawGrid(pane, x, y, s) {
      const c = this.context;
      c.beginPath();
      for (let i = Math.max(0, Math.ceil((pane.x - x) / s)); i <= this.width && x + i * s <= pane.x + pane.w; ++i) { c.moveTo(x + i * s, pane.y); c.lineTo(x + i * s, pane.y + pane.h); }
      for (let j = Math.max(0, Math.ceil((pane.y - y) / s)); j <= this.height && y + j * s <= pane.y + pane.h; ++j) { c.moveTo(pane.x, y + j * s); c.lineTo(pane.x + pane.w, y + j * s); }
      c.strokeStyle = 'rgb(128 128 128 / .35)';
      c.lineWidth = 1;
      c.stroke();
    }
    drawWipe() {
      const c = this.context, pane = this.panes()[0], at = this.divider * pane.w;
      this.drawPane(pane, this.left, { ...pane, w: at });
      this.drawPane(pane, this.right, { ...pane, x: at, w: pane.w - at });
      c.fillStyle = 'rgb(0 0 0 / .45)';
      c.fillRect(at - 1.5, 0, 3, pane.h);
      c.fillStyle = '#fff';
      c.fillRect(at - 0.75, 0, 1.5, pane.h);
      c.beginPath();
      c.arc(at, pane.h / 2, 13, 0, 7);
      c.fillStyle = '#fff';
      c.fill();
      c.strokeStyle = 'rgb(0 0 0 / .35)';
      c.lineWidth = 1;
      c.stroke();
      c.beginPath();
      for (const d of [-1, 1]) { c.moveTo(at + d * 3.5, pane.h / 2 - 4.5); c.lineTo(at + d * 8, pane.h / 2); c.lineTo(at + d * 3.5, pane.h / 2 + 4.5); }
      c.strokeStyle = '#30363d';
      c.lineWidth = 1.8;
      c.stroke();
      this.drawLabel({ ...pane, w: at }, this.labels[this.left], false);
      this.drawLabel({ ...pane, x: at, w: pane.w - at }, this.labels[this.right], true);
    }
    drawLabel(area, label, toRight) {
      const c = this.context;
      c.save();
      c.beginPath();
      c.rect(area.x, area.y, area.w, area.h);
      c.clip();
      c.font = '600 12px system-ui, sans-serif';
      c.textBaseline = 'middle';
      const width = c.measureText(label).width + 16, x = toRight ? area.x + area.w - width - 10 : area.x + 10;
      c.fillStyle = 'rgb(15 18 22 / .72)';
      c.beginPath();
      if (c.roundRect) c.roundRect(x, area.y + 10, width, 22, 5); else c.rect(x, area.y + 10, width, 22);
      c.fill();
      c.fillStyle = '#fff';
      c.fillText(label, x + 8, area.y + 21.5);
      c.restore();
    }

    // -- Readout
    pixel(i, x, y) {
      if (!this.values[i]) {
        const copy = element('canvas', { width: this.width, height: this.height });
        const c = copy.getContext('2d', { willReadFrequently: true });
        c.drawImage(this.images[i], 0, 0);
        this.values[i] = c.getImageData(0, 0, this.width, this.height).data;
      }
      const at = 4 * (y * this.width + x);
      return [...this.values[i].subarray(at, at + 3)];
    }
    report() {
      const point = this.hover;
      if (!point || point.x < 0 || point.y < 0 || point.x >= this.width || point.y >= this.height) {
        this.status.textContent = `${this.width} × ${this.height} pixels. Click, then wheel to zoom; drag to move; double-click to zoom in.`;
        return;
      }
      const x = Math.floor(point.x), y = Math.floor(point.y);
      const shown = this.mode === 'wipe' ? [...new Set([this.left, this.right])] : this.mode === 'flip' ? [this.current] : this.images.map((_, i) => i);
      this.status.replaceChildren(element('b', {}, `x ${x}, y ${y}`), ...shown.map((i) => {
        const [r, g, b] = this.pixel(i, x, y);
        return element('span', {}, element('i', { class: 'swatch', style: `background: rgb(${r} ${g} ${b})` }), `${this.labels[i]}: ${r} ${g} ${b}`);
      }));
    }

    // -- Input
    listen() {
      const canvas = this.canvas;
      const position = (event) => { const r = canvas.getBoundingClientRect(); return { x: event.clientX - r.left, y: event.clientY - r.top }; };
      const overDivider = (p) => this.mode === 'wipe' && Math.abs(p.x - this.divider * this.stage.w) < 14;
      let drag = null;
      canvas.addEventListener('pointerdown', (event) => {
        const p = position(event);
        canvas.focus({ preventScroll: true });
        drag = { ...p, wipe: overDivider(p), centre: { ...this.centre } };
        canvas.setPointerCapture(event.pointerId);
        canvas.classList.toggle('panning', !drag.wipe);
      });
      canvas.addEventListener('pointermove', (event) => {
        const p = position(event), pane = this.paneAt(p.x, p.y);
        this.hover = pane ? this.toImage(pane, p.x, p.y) : null;
        canvas.classList.toggle('wiping', drag ? drag.wipe : overDivider(p));
        if (drag && drag.wipe) this.divider = Math.min(1, Math.max(0, p.x / this.stage.w));
        else if (drag) this.centre = { x: drag.centre.x - (p.x - drag.x) / this.scale(), y: drag.centre.y - (p.y - drag.y) / this.scale() };
        if (drag) this.refresh(); else this.report();
      });
      const end = () => { drag = null; canvas.classList.remove('panning', 'wiping'); };
      canvas.addEventListener('pointerup', end);
      canvas.addEventListener('pointercancel', end);
      canvas.addEventListener('pointerleave', () => { this.hover = null; this.report(); });
      canvas.addEventListener('dblclick', (event) => {
        const p = position(event);
        this.setZoom(this.scale() * 2, { ...p, pane: this.paneAt(p.x, p.y) || this.panes()[0] });
      });
      canvas.addEventListener('wheel', (event) => {
        // The page scrolls past an image that nobody clicked.
        if (document.activeElement !== canvas && !event.ctrlKey) return;
        event.preventDefault();
        const p = position(event), lines = event.deltaMode === 1 ? 30 : 1;
        this.setZoom(this.scale() * Math.exp(-event.deltaY * lines * 0.0018), { ...p, pane: this.paneAt(p.x, p.y) || this.panes()[0] });
      }, { passive: false });
      canvas.addEventListener('keydown', (event) => this.key(event));
      new ResizeObserver(() => { if (this.box.clientWidth !== this.stage.w) this.layout(); }).observe(this.box);
      document.addEventListener('fullscreenchange', () => this.layout());
    }
    key(event) {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const step = 40 / this.scale(), key = event.key.toLowerCase();
      const move = (dx, dy) => () => { this.centre.x += dx; this.centre.y += dy; this.refresh(); };
      const wipe = (d) => () => { this.divider = Math.min(1, Math.max(0, this.divider + d)); this.refresh(); };
      const wiping = this.mode === 'wipe' && !event.shiftKey;
      const actions = {
        f: () => this.setMode('flip'), w: () => this.setMode('wipe'), s: () => this.setMode('side'),
        ' ': () => this.show(this.previous), '+': () => this.setZoom(this.scale() * 2), '-': () => this.setZoom(this.scale() / 2),
        '=': () => this.setZoom(1 / devicePixelRatio), '0': () => this.fit(),
        arrowleft: wiping ? wipe(-0.02) : move(-step, 0), arrowright: wiping ? wipe(0.02) : move(step, 0),
        arrowup: move(0, -step), arrowdown: move(0, step),
      };
      const number = Number(key);
      if (key >= '1' && key <= '9' && number <= this.images.length) this.show(number - 1);
      else if (actions[key]) actions[key]();
      else return;
      event.preventDefault();
    }
  }

  async function setupComparison(figure) {
    const images = [...figure.querySelectorAll('.sources img')];
    await Promise.all(images.map((image) => image.decode()));
    new Comparison(figure, images);
  }

  setupTheme();
  setupContents();
  document.querySelectorAll('table.sortable').forEach(setupTable);
  document.querySelectorAll('.compare').forEach(setupComparison);
})();
