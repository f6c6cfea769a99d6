// The pictures that the page holds, and what can be composed of them. A method's difference picture
// holds two masks: in its colours the red channel tells the truth's answer, the blue one the
// method's. A shading is the lit layer of its mesh where a mask is lit, and the dark one elsewhere.
const dark = 0, lit = 1, none = 2;
const split = 160;  // between the dark and the light values of both channels

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

/// The method's mask in a difference picture: channel 2; its truth's: channel 0.
function maskOfDifference(pixels, channel) {
  const mask = new Uint8Array(pixels.length / 4);
  for (let i = 0, p = 0; i < mask.length; ++i, p += 4) {
    const white = pixels[p] > 245 && pixels[p + 1] > 245 && pixels[p + 2] > 245;
    mask[i] = white ? none : pixels[p + channel] > split ? lit : dark;
  }
  return mask;
}

/// A mask picture: white lit, black dark, grey none.
function maskOfMask(pixels) {
  const mask = new Uint8Array(pixels.length / 4);
  for (let i = 0, p = 0; i < mask.length; ++i, p += 4) {
    mask[i] = pixels[p] > 192 ? lit : pixels[p] < 64 ? dark : none;
  }
  return mask;
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
    this.layers = panel.querySelector('.layers');
    this.pictures = [...panel.querySelectorAll('figure')].flatMap((figure) => this.picturesOf(figure));
    this.kept = new Map();
  }

  picturesOf(figure) {
    const {letter, name, rate, mesh} = figure.dataset;
    const whole = figure.querySelector('img.whole');
    const picture = {letter, name, rate: rate || '', figure, mesh};
    picture.difference = figure.querySelector('img.difference');
    picture.isTruth = figure.dataset.method === 'truth';
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

  mask(picture) {
    return this.keep('mask ' + picture.letter, async () => {
      if (!picture.isTruth) return maskOfDifference(await pixelsOf(picture.difference), 2);
      return maskOfMask(await pixelsOf(this.layers.querySelector('img.truth')));
    });
  }

  async truthOf(picture) {
    return maskOfDifference(await pixelsOf(picture.difference), 0);
  }

  layer(kind, mesh) {
    return this.keep(kind + mesh, async () => {
      const image = this.layers.querySelector(`img.${kind}[data-mesh="${mesh}"]`);
      return new Uint32Array((await pixelsOf(image)).buffer);
    });
  }

  /// A picture as it is shaded.
  shading(picture) {
    if (picture.whole) return this.keep('whole ' + picture.letter, () => this.copyOf(picture.whole));
    return this.keep('shading ' + picture.letter, async () => {
      const [mask, light, shadow] = await Promise.all([
        this.mask(picture), this.layer('lit', picture.mesh), this.layer('dark', picture.mesh)
      ]);
      return painted(this.width, this.height, (words) => {
        for (let i = 0; i < words.length; ++i) words[i] = mask[i] === dark ? shadow[i] : light[i];
      });
    });
  }

  async copyOf(image) {
    await image.decode();
    const canvas = canvasOf(this.width, this.height);
    canvas.getContext('2d').drawImage(image, 0, 0, this.width, this.height);
    return canvas;
  }

  /// A picture as its mask alone; one that is no method's stays as it is.
  async shadows(picture) {
    if (picture.whole) return this.shading(picture);
    const mask = await this.mask(picture);
    const colours = [wordOf(0, 0, 0), wordOf(255, 255, 255), wordOf(128, 128, 128)];
    return painted(this.width, this.height, (words) => {
      for (let i = 0; i < words.length; ++i) words[i] = colours[mask[i]];
    });
  }

  /// Where two pictures answer differently, and which way: a canvas, and the share of the pixels.
  /// Null where they draw different meshes, unless one of them is the truth: a method is held
  /// against the truth at its own mesh's points.
  async difference(a, b) {
    if (a.whole || b.whole) return null;
    const own = a.mesh === b.mesh;
    if (!own && !a.isTruth && !b.isTruth) return null;
    const first = !own && a.isTruth ? await this.truthOf(b) : await this.mask(a);
    const second = !own && b.isTruth ? await this.truthOf(a) : await this.mask(b);
    const colour = (name) => wordOf(...getComputedStyle(document.documentElement)
        .getPropertyValue(name).match(/\d+/g).map(Number));
    const colours = [
      colour('--both-shadowed'), colour('--false-light'),
      colour('--false-shadow'), colour('--both-lit')
    ];
    let samples = 0, darker = 0, lighter = 0;
    const canvas = painted(this.width, this.height, (words) => {
      for (let i = 0; i < words.length; ++i) {
        if (first[i] === none || second[i] === none) {
          words[i] = 0;
          continue;
        }
        ++samples;
        darker += first[i] < second[i];
        lighter += first[i] > second[i];
        words[i] = colours[first[i] + 2 * second[i]];
      }
    });
    return {canvas, darker: darker / samples, lighter: lighter / samples};
  }
}
