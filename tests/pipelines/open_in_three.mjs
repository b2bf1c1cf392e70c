// Opens a .glb with three.js's GLTFLoader, in node, and counts meshes and triangles:
//   NODE_MODULES=FOLDER/node_modules node open_in_three.mjs city.glb
// Install the modules with npm install --prefix FOLDER three draco3dgltf. Prints "meshes M triangles T min x y z max x y z"
// in glTF's axes (y up). Exit code 2 when the modules are missing.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const modules = path.resolve(process.env.NODE_MODULES ?? 'node_modules');
const load = (file) => import(pathToFileURL(path.join(modules, file)).href);
globalThis.self = globalThis; // the loader expects a browser
let three, loader, draco;
try {
  three = await load('three/build/three.module.js');
  loader = await load('three/examples/jsm/loaders/GLTFLoader.js');
  draco = await createRequire(path.join(modules, 'anchor.js'))('draco3dgltf').createDecoderModule({});
} catch (error) {
  console.error(`open_in_three: no three or draco3dgltf in ${modules}: ${error.message}`);
  process.exit(2);
}

// DRACOLoader decodes in a worker of a browser. In node, the same decoder is called directly, behind the methods that
// GLTFLoader uses.
const dracoLoader = {
  preload() {},
  async decodeDracoFile(bytes, done, ids, types) {
    const decoder = new draco.Decoder(), mesh = new draco.Mesh(), array = new Int8Array(bytes);
    const status = decoder.DecodeArrayToMesh(array, array.byteLength, mesh);
    if (!status.ok()) throw new Error(status.error_msg());
    const geometry = new three.BufferGeometry();
    const index = new Uint32Array(mesh.num_faces() * 3), face = new draco.DracoInt32Array();
    for (let f = 0; f < mesh.num_faces(); ++f) {
      decoder.GetFaceFromMesh(mesh, f, face);
      for (let k = 0; k < 3; ++k) index[3 * f + k] = face.GetValue(k);
    }
    geometry.setIndex(new three.BufferAttribute(index, 1));
    for (const [name, id] of Object.entries(ids)) {
      const attribute = decoder.GetAttributeByUniqueId(mesh, id), values = new draco.DracoFloat32Array();
      decoder.GetAttributeFloatForAllPoints(mesh, attribute, values);
      const typed = new Float32Array(values.size());
      for (let i = 0; i < typed.length; ++i) typed[i] = values.GetValue(i);
      geometry.setAttribute(name, new three.BufferAttribute(typed, attribute.num_components()));
    }
    done(geometry);
  },
};

const bytes = await readFile(process.argv[2]);
const gltf = await new loader.GLTFLoader()
  .setDRACOLoader(dracoLoader)
  .parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength), '');
gltf.scene.updateMatrixWorld(true);
let meshes = 0, triangles = 0;
const box = new three.Box3();
gltf.scene.traverse((thing) => {
  if (!thing.isMesh) return;
  const count = thing.isInstancedMesh ? thing.count : 1;
  ++meshes;
  triangles += (count * thing.geometry.index.count) / 3;
  if (thing.isInstancedMesh) thing.computeBoundingBox();
  else thing.geometry.computeBoundingBox();
  box.union((thing.isInstancedMesh ? thing.boundingBox : thing.geometry.boundingBox).clone().applyMatrix4(thing.matrixWorld));
});
const text = (v) => v.toArray().map((x) => x.toFixed(3)).join(' ');
console.log(`meshes ${meshes} triangles ${triangles} min ${text(box.min)} max ${text(box.max)}`);
