// What the picture's view does with the extension's messages (preview.js).
'use strict';
const editor = acquireVsCodeApi();
const [picture, state, cameras, camera] = ['picture', 'state', 'cameras', 'camera'].map((id) => document.getElementById(id));
let told = null;

picture.onload = () => {
  URL.revokeObjectURL(picture.src);
  picture.hidden = false;
};
camera.onchange = () => editor.postMessage({ camera: camera.value });
addEventListener('message', ({ data }) => {
  if (data.png) {
    picture.src = URL.createObjectURL(new Blob([data.png], { type: 'image/png' }));
    picture.width = data.width;
    picture.height = data.height;
  }
  if (data.part !== undefined) {
    told = data;
    state.textContent = data.whole ? `${picture.width} x ${picture.height}, samples: ${data.samples}, ${Math.round(data.ms)} ms` : 'Drawing';
    const { part, whole } = data;
    picture.decode().then(() => editor.postMessage({ shown: { width: picture.naturalWidth, height: picture.naturalHeight, part, whole: !!whole } }), () => {});
  }
  if (data.failed) {
    state.textContent = `${data.failed}. ${told ? 'The picture is of the text before.' : 'There is no picture yet.'}`;
    editor.postMessage({ shown: { failed: data.failed } });
  }
  if (data.cameras) {
    cameras.hidden = data.cameras.length < 2;
    camera.replaceChildren(...data.cameras.map((name, i) => new Option(name, i ? name : '', false, name === data.camera)));
  }
});
editor.postMessage({ ready: true });
