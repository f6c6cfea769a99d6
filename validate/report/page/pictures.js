// The pictures that the page holds, and what can be composed of them. A method's difference picture
// holds the truth's shares of light and the method's: 1 lit, 0 dark, between them under a soft light,
// NaN no sample. Under a hard light a shading is the lit layer of its mesh, and where the mask is
// dark the dark one; under a soft one the page has it whole.

/// The colours of a signed difference, as the page's style has them: red, green, blue.
function differenceColours() {
  const style = getComputedStyle(document.documentElement);
  const colour = (name) => style.getPropertyValue(name).match(/\d+/g).map(Number);
  return {
    falseShadow: colour('--false-shadow'), falseLight: colour('--false-light'),
    lit: colour('--both-lit'), dark: colour('--both-shadowed')
  };
}

function canvasOf(width, height) {
  const canvas = document.createElement('canvas');
  canvas.width = width;
  canvas.height = height;
  return canvas;
}

/// The pixels of an image element, four bytes each.
async function pixelsOf(image) {
  await image.decode();
  const context =
      canvasOf(image.naturalWidth, image.naturalHeight).getContext('2d', {willReadFrequently: true});
  context.drawImage(image, 0, 0);
  return context.getImageData(0, 0, image.naturalWidth, image.naturalHeight).data;
}

/// The method's shares in a difference picture, or its truth's. A colour there is the grey of the
/// truth's share, mixed with that of the error by how much they differ: only the latter has tint.
function sharesOfDifference(pixels, ofTruth) {
  const {falseShadow, falseLight, lit, dark} = differenceColours();
  const shares = new Float32Array(pixels.length / 4);
  for (let i = 0, p = 0; i < shares.length; ++i, p += 4) {
    const red = pixels[p], green = pixels[p + 1], blue = pixels[p + 2];
    if (red > 245 && green > 245 && blue > 245) {
      shares[i] = NaN;
      continue;
    }
    const darker = red > blue;
    const error = darker ? falseShadow : falseLight;
    const off = Math.min(1, (red - blue) / (error[0] - error[2]));
    const grey = off < 1 ? (green - off * error[1]) / (1 - off) : 0;
    const truth = (grey - dark[1]) / (lit[1] - dark[1]);
    // The method's share is one, too.
    const possible = darker ? Math.min(1, Math.max(off, truth)) : Math.min(1 - off, Math.max(0, truth));
    shares[i] = ofTruth ? possible : possible + (darker ? -off : off);
  }
  return shares;
}

/// A mask picture: white lit, black dark, grey none.
function sharesOfMask(pixels) {
  const shares = new Float32Array(pixels.length / 4);
  for (let i = 0, p = 0; i < shares.length; ++i, p += 4) {
    shares[i] = pixels[p] > 192 ? 1 : pixels[p] < 64 ? 0 : NaN;
  }
  return shares;
}

/// A canvas that `paint` fills, one word a pixel.
function painted(width, height, paint) {
  const canvas = canvasOf(width, height);
  const context = canvas.getContext('2d');
  const data = context.createImageData(width, height);
  const words = new Uint32Array(data.data.buffer);
  paint(words);
  context.putImageData(data, 0, 0);
  return canvas;
}

/// A colour as the word that four bytes make on this machine.
function wordOf(red, green, blue) {
  return new Uint32Array(new Uint8Array([red, green, blue, 255]).buffer)[0];
}

/// One view under one light: its figures as the page shows them.
class Scene {
  constructor(panel) {
    this.title = panel.dataset.title;
    this.width = Number(panel.dataset.width);
    this.height = Number(panel.dataset.height);
    this.isSoft = panel.dataset.soft !== undefined;
    this.best = panel.dataset.best;
    this.layers = panel.querySelector('.layers');
    this.pictures = [...panel.querySelectorAll('figure')].flatMap((figure) => this.picturesOf(figure));
    this.kept = new Map();
  }

  picturesOf(figure) {
    const {letter, name, rate, mesh} = figure.dataset;
    const shaded = figure.querySelector('img.shaded.whole');  // under a soft light
    const whole = figure.querySelector('img.whole:not(.shaded)');
    const picture = {letter, name, rate: rate || '', figure, mesh, shaded};
    picture.difference = figure.querySelector('img.difference');
    picture.isTruth = figure.dataset.method === 'truth';
    picture.isBest = figure.dataset.method === this.best;
    if (mesh === undefined) return whole ? [{...picture, whole}] : [];
    if (!whole) return [picture];
    return [picture, {letter: letter + '′', name: whole.alt, rate: '', figure, whole}];
  }

  /// Does `work` once for a key; keeps the last eight results.
  keep(key, work) {
    if (!this.kept.has(key)) {
      if (this.kept.size >= 8) this.kept.delete(this.kept.keys().next().value);
      this.kept.set(key, work());
    }
    return this.kept.get(key);
  }

  shares(picture) {
    return this.keep('shares ' + picture.letter, async () => {
      if (!picture.isTruth) return sharesOfDifference(await pixelsOf(picture.difference), false);
      const pixels = await pixelsOf(this.layers.querySelector('img.truth'));
      return this.isSoft ? sharesOfDifference(pixels, true) : sharesOfMask(pixels);
    });
  }

  async truthOf(picture) {
    return sharesOfDifference(await pixelsOf(picture.difference), true);
  }

  layer(kind, mesh) {
    return this.keep(kind + mesh, async () => {
      const image = this.layers.querySelector(`img.${kind}[data-mesh="${mesh}"]`);
      return new Uint32Array((await pixelsOf(image)).buffer);
    });
  }

  /// A picture as it is shaded.
  shading(picture) {
    const whole = picture.whole || picture.shaded;
    if (whole) return this.keep('whole ' + picture.letter, () => this.copyOf(whole));
    return this.keep('shading ' + picture.letter, async () => {
      const [shares, light, shadow] = await Promise.all([
        this.shares(picture), this.layer('lit', picture.mesh), this.layer('dark', picture.mesh)
      ]);
      return painted(this.width, this.height, (words) => {
        for (let i = 0; i < words.length; ++i) words[i] = shares[i] === 0 ? shadow[i] : light[i];
      });
    });
  }

  async copyOf(image) {
    await image.decode();
    const canvas = canvasOf(this.width, this.height);
    canvas.getContext('2d').drawImage(image, 0, 0, this.width, this.height);
    return canvas;
  }

  /// A picture as its mask alone, of a soft light as its shares; one that is no method's stays as it is.
  async shadows(picture) {
    if (picture.whole) return this.shading(picture);
    const shares = await this.shares(picture);
    const greys = Array.from({length: 256}, (_, grey) => wordOf(grey, grey, grey));
    return painted(this.width, this.height, (words) => {
      for (let i = 0; i < words.length; ++i) {
        words[i] = greys[isNaN(shares[i]) ? 128 : Math.round(255 * shares[i])];
      }
    });
  }

  /// Where two pictures answer differently, and which way: a canvas, and the mean over the pixels.
  /// Null where they draw different meshes, unless one of them is the truth: a method is held
  /// against the truth at its own mesh's points.
  async difference(a, b) {
    if (a.whole || b.whole) return null;
    if (a.mesh !== b.mesh && !a.isTruth && !b.isTruth) return null;
    const first = a.isTruth && !b.isTruth ? await this.truthOf(b) : await this.shares(a);
    const second = b.isTruth && !a.isTruth ? await this.truthOf(a) : await this.shares(b);
    const {falseShadow, falseLight, lit, dark} = differenceColours();
    const colour = (off, share) => wordOf(...(off > 0 ? falseLight : falseShadow).map((error, k) => {
      const grey = dark[k] + share * (lit[k] - dark[k]);
      return Math.round(grey + Math.abs(off) * (error - grey));
    }));
    const known = new Map();  // by both shares: most pixels have one of four
    let samples = 0, darker = 0, lighter = 0;
    const canvas = painted(this.width, this.height, (words) => {
      for (let i = 0; i < words.length; ++i) {
        if (isNaN(first[i]) || isNaN(second[i])) {
          words[i] = 0;
          continue;
        }
        const off = first[i] - second[i];
        ++samples;
        darker += Math.max(0, -off);
        lighter += Math.max(0, off);
        const key = 512 * Math.round(511 * first[i]) + Math.round(511 * second[i]);
        if (!known.has(key)) known.set(key, colour(off, second[i]));
        words[i] = known.get(key);
      }
    });
    return {canvas, darker: darker / samples, lighter: lighter / samples};
  }
}
