// SPDX-License-Identifier: BSD-3-Clause
// The deformed body in three actors of vtk.js: faces of the bodies, their outline, the interfaces. All colours are
// computed here, so that the legend says what is seen.
import '@kitware/vtk.js/Rendering/OpenGL/Profiles/Geometry';
import vtkActor from '@kitware/vtk.js/Rendering/Core/Actor';
import vtkDataArray from '@kitware/vtk.js/Common/Core/DataArray';
import vtkInteractor from '@kitware/vtk.js/Rendering/Core/RenderWindowInteractor';
import vtkMapper from '@kitware/vtk.js/Rendering/Core/Mapper';
import vtkOpenGLRenderWindow from '@kitware/vtk.js/Rendering/OpenGL/RenderWindow';
import vtkPoints from '@kitware/vtk.js/Common/Core/Points';
import vtkPolyData from '@kitware/vtk.js/Common/DataModel/PolyData';
import vtkRenderer from '@kitware/vtk.js/Rendering/Core/Renderer';
import vtkRenderWindow from '@kitware/vtk.js/Rendering/Core/RenderWindow';
import vtkStyle from '@kitware/vtk.js/Interaction/Style/InteractorStyleManipulator';
import vtkGestures from '@kitware/vtk.js/Interaction/Manipulators/GestureCameraManipulator';
import vtkPan from '@kitware/vtk.js/Interaction/Manipulators/MouseCameraTrackballPanManipulator';
import vtkRotate from '@kitware/vtk.js/Interaction/Manipulators/MouseCameraTrackballRotateManipulator';
import vtkZoom from '@kitware/vtk.js/Interaction/Manipulators/MouseCameraTrackballZoomToMouseManipulator';
import { ColorMode, ScalarMode } from '@kitware/vtk.js/Rendering/Core/Mapper/Constants';

import { bytesOfTone, painted } from './colours.js';
import { nothing, widen } from './data.js';
import { bodyOfNodes, box, cellArray, outline } from './geometry.js';

const components = ['xx', 'yy', 'zz', 'xy', 'yz', 'zx'];

// From where to look, and what is up.
export const views = {
  space: {
    oblique: { from: [-0.55, -1, 0.6], up: [0, 0, 1] },
    'along x': { from: [-1, 0, 0], up: [0, 0, 1] },
    'along y': { from: [0, -1, 0], up: [0, 0, 1] },
    'along z': { from: [0, 0, 1], up: [0, 1, 0] },
  },
  plane: { fit: { from: [0, 0, 1], up: [0, 1, 0] } },
};

function vonMises(stress, count) {
  const [xx, yy, zz, xy, yz, zx] = components.map((_, c) => stress.subarray(c * count, (c + 1) * count));
  return Float32Array.from(xx, (_, i) =>
    Math.sqrt(
      0.5 * ((xx[i] - yy[i]) ** 2 + (yy[i] - zz[i]) ** 2 + (zz[i] - xx[i]) ** 2) +
        3 * (xy[i] ** 2 + yz[i] ** 2 + zx[i] ** 2),
    ),
  );
}

function actorOf(data) {
  const mapper = vtkMapper.newInstance({ colorMode: ColorMode.DIRECT_SCALARS });
  const actor = vtkActor.newInstance();
  mapper.setInputData(data);
  actor.setMapper(mapper);
  return actor;
}

function paint(actor, data, bytes, ofCells) {
  const scalars = vtkDataArray.newInstance({ name: 'colours', numberOfComponents: 3, values: bytes });
  data[ofCells ? 'getPointData' : 'getCellData']().setScalars(null);
  data[ofCells ? 'getCellData' : 'getPointData']().setScalars(scalars);
  actor.getMapper().setScalarMode(ofCells ? ScalarMode.USE_CELL_DATA : ScalarMode.USE_POINT_DATA);
  actor.getMapper().setScalarVisibility(true);
  data.modified();
}

export class Scene {
  // onCamera: called with the camera after each picture.
  constructor(container, mesh, onCamera) {
    this.container = container;
    this.mesh = mesh;
    this.onCamera = onCamera;
    this.faces = mesh.faces.offsets.length - 1;
    this.whole = box(mesh.points);
    this.nodeBody = bodyOfNodes(mesh.points.length / 3, mesh.faces, mesh.body);
    for (const { sides, faces } of mesh.interfaces) this.spread(sides, faces);
    this.bodies = 1 + mesh.body.reduce((most, body) => Math.max(most, body), 0);
    this.makeWindow();
    this.makeActors();
  }

  // Nodes inside an interface are on no face of a body: they are of the body of those beside them.
  spread(sides, { offsets, nodes }) {
    for (const side of sides) {
      const known = side.find((node) => this.nodeBody[node] >= 0);
      if (known === undefined) continue;
      for (const node of side) if (this.nodeBody[node] < 0) this.nodeBody[node] = this.nodeBody[known];
    }
    return offsets.length + nodes.length;
  }

  makeWindow() {
    this.window = vtkRenderWindow.newInstance();
    this.renderer = vtkRenderer.newInstance();
    this.window.addRenderer(this.renderer);
    this.view = vtkOpenGLRenderWindow.newInstance();
    this.view.setContainer(this.container);
    this.window.addView(this.view);
    this.renderer.getActiveCamera().setParallelProjection(true);
    this.interactor = vtkInteractor.newInstance();
    this.interactor.setView(this.view);
    this.interactor.initialize();
    this.interactor.bindEvents(this.container);
    const style = vtkStyle.newInstance();
    const add = (kind, wishes) => style.addMouseManipulator(kind.newInstance(wishes));
    if (!this.mesh.flat) add(vtkRotate, { button: 1 });
    add(vtkPan, { button: 1, shift: !this.mesh.flat });
    add(vtkPan, { button: 2 });
    add(vtkPan, { button: 3 });
    add(vtkZoom, { scrollEnabled: true, dragEnabled: false });
    style.addGestureManipulator(vtkGestures.newInstance({ rotateEnabled: false }));
    this.interactor.setInteractorStyle(style);
    this.renderer.getActiveCamera().onModified(() => this.onCamera(this.renderer.getActiveCamera()));
    new ResizeObserver(() => this.resize()).observe(this.container);
  }

  makeActors() {
    const { mesh } = this;
    this.points = vtkPoints.newInstance();
    this.points.setData(Float32Array.from(mesh.points), 3);
    this.bodyData = vtkPolyData.newInstance();
    this.bodyData.setPoints(this.points);
    this.bodyData.getPolys().setData(cellArray(mesh.faces));
    this.body = actorOf(this.bodyData);
    this.body.getProperty().set({ interpolation: 0, ambient: mesh.flat ? 1 : 0.35, diffuse: mesh.flat ? 0 : 0.65 });

    this.edgeData = vtkPolyData.newInstance();
    this.edgeData.setPoints(this.points);
    this.edgeData.getLines().setData(outline(mesh.points, mesh.faces));
    this.edges = actorOf(this.edgeData);
    this.edges.getMapper().setScalarVisibility(false);
    this.edges.getProperty().set({ lighting: false });

    this.interfaceData = vtkPolyData.newInstance();
    this.interfacePoints = vtkPoints.newInstance();
    this.interfaceData.setPoints(this.interfacePoints);
    this.interfaces = actorOf(this.interfaceData);
    this.interfaces.getProperty().set({
      lighting: !mesh.flat,
      ambient: 0.55,
      diffuse: 0.45,
      interpolation: 0,
      lineWidth: mesh.flat ? 3 * Math.max(1, window.devicePixelRatio || 1) : 1,
    });
    for (const actor of [this.body, this.edges, this.interfaces]) this.renderer.addActor(actor);
    this.edges.getMapper().setResolveCoincidentTopologyToPolygonOffset();
    this.showInterfaces('all');
  }

  // which: 'all', 'none', or the number of one.
  showInterfaces(which) {
    this.shownInterfaces = this.mesh.interfaces
      .map((one, index) => ({ ...one, index }))
      .filter(({ index }) => which === 'all' || which === String(index));
    const blocks = [];
    let shift = 0;
    for (const { sides, faces } of this.shownInterfaces) {
      for (const side of sides) {
        blocks.push(cellArray(faces, shift));
        shift += side.length;
      }
    }
    this.interfacePoints.setData(new Float32Array(3 * shift), 3);
    const cells = new Uint32Array(blocks.reduce((sum, block) => sum + block.length, 0));
    let at = 0;
    for (const block of blocks) {
      cells.set(block, at);
      at += block.length;
    }
    this.interfaceData[this.mesh.flat ? 'getLines' : 'getPolys']().setData(cells);
    this.interfaceData[this.mesh.flat ? 'getLines' : 'getPolys']().modified();
    this.interfaces.setVisibility(shift > 0);
  }

  // Where the nodes are: `scale` times displaced, the bodies pulled apart across their layers.
  move(step, scale, apart) {
    const { points } = this.mesh;
    const to = this.points.getData();
    const u = step.displacement;
    const across = this.mesh.flat ? 1 : 2;
    const gap = (apart * 0.6 * this.whole.size) / Math.max(1, this.bodies);
    for (let i = 0; i < points.length; i += 1) to[i] = points[i] + (u ? scale * u[i] : 0);
    if (gap > 0) {
      for (let i = 0; i < this.nodeBody.length; i += 1) to[3 * i + across] += gap * Math.max(0, this.nodeBody[i]);
    }
    const on = this.interfacePoints.getData();
    let at = 0;
    for (const { sides } of this.shownInterfaces) {
      for (const side of sides) {
        for (const node of side) {
          for (let c = 0; c < 3; c += 1) on[at + c] = to[3 * node + c];
          // In the plane, lines lie upon the cells.
          if (this.mesh.flat) on[at + 2] += 1e-3 * this.whole.size;
          at += 3;
        }
      }
    }
    this.points.modified();
    this.interfacePoints.modified();
    for (const data of [this.bodyData, this.edgeData, this.interfaceData]) data.modified();
  }

  // What the select of the page offers: keys with titles.
  static fields(step, flat) {
    const out = [['body', 'by body']];
    if (step.displacement) out.push(['u', 'displacement'], ['ux', 'displacement x'], ['uy', 'displacement y']);
    if (step.displacement && !flat) out.push(['uz', 'displacement z']);
    if (step.stress) {
      out.push(['mises', 'stress, von Mises']);
      for (const c of components) if (!flat || !c.includes('z') || c === 'zz') out.push([c, `stress ${c}`]);
    }
    return out;
  }

  fieldOf(step, key) {
    if (key.startsWith('u')) {
      const u = step.displacement;
      const c = 'xyz'.indexOf(key[1]);
      return Float32Array.from({ length: u.length / 3 }, (_, i) =>
        key === 'u' ? Math.hypot(u[3 * i], u[3 * i + 1], u[3 * i + 2]) : u[3 * i + c],
      );
    }
    if (key === 'mises') return vonMises(step.stress, this.faces);
    const c = components.indexOf(key);
    return step.stress.slice(c * this.faces, (c + 1) * this.faces);
  }

  // Returns the range of the colours, null for those of the bodies; without a wish it is that of the step.
  paint(step, key, colours, wished) {
    const range = this.paintBodies(step, key, colours, wished);
    const values = [];
    for (const { sides, index } of this.shownInterfaces) {
      // Without the field, as if intact.
      const zeta = step.adhesion[index] ?? new Float32Array(sides[0].length).fill(1);
      for (let s = 0; s < sides.length; s += 1) values.push(painted(zeta, 0, 1, colours.adhesion));
    }
    const bytes = new Uint8Array(values.reduce((sum, part) => sum + part.length, 0));
    let at = 0;
    for (const part of values) {
      bytes.set(part, at);
      at += part.length;
    }
    paint(this.interfaces, this.interfaceData, bytes, false);
    return range;
  }

  paintBodies(step, key, colours, wished) {
    if (key === 'body') {
      const bytes = new Uint8Array(3 * this.faces);
      for (let i = 0; i < this.faces; i += 1) bytes.set(bytesOfTone(this.mesh.body[i]), 3 * i);
      paint(this.body, this.bodyData, bytes, true);
      return null;
    }
    const values = this.fieldOf(step, key);
    const { low, high } = wished ?? widen(nothing(), values);
    paint(this.body, this.bodyData, painted(values, low, high, colours.field), !key.startsWith('u'));
    return { low, high };
  }

  look({ opacity, mesh, background, edge }) {
    this.renderer.setBackground(...background);
    this.body.getProperty().setOpacity(opacity);
    this.body.setVisibility(opacity > 0);
    this.body.getProperty().setEdgeVisibility(mesh);
    this.body.getProperty().setEdgeColor(...edge);
    this.edges.getProperty().setColor(...edge);
  }

  // The whole body, from where it is looked at.
  fit(view) {
    const camera = this.renderer.getActiveCamera();
    const { low, high } = box(this.points.getData());
    const middle = low.map((value, c) => 0.5 * (value + high[c]));
    const distance = 2 * Math.hypot(...high.map((value, c) => value - low[c])) || 1;
    const from = view ? view.from : camera.getDirectionOfProjection().map((value) => -value);
    const length = Math.hypot(...from);
    if (view) camera.setViewUp(...view.up);
    camera.setFocalPoint(...middle);
    camera.setPosition(...middle.map((value, c) => value + (distance * from[c]) / length));
    this.fittedBelow = this.legendHeight();
    this.fittedScale = this.scaleThatFits(camera, low, high, middle);
    camera.setParallelScale(this.fittedScale);
    this.renderer.resetCameraClippingRange();
    this.onCamera(camera);
  }

  // Nobody has zoomed since.
  isFitted() {
    return this.renderer.getActiveCamera().getParallelScale() === this.fittedScale;
  }

  // A later step, or a larger scale, reaches beyond what was fitted.
  isOutgrown() {
    const camera = this.renderer.getActiveCamera();
    const { low, high } = box(this.points.getData());
    return this.scaleThatFits(camera, low, high, camera.getFocalPoint()) > 1.001 * this.fittedScale;
  }

  legendHeight() {
    return this.container.querySelector('#legend')?.offsetHeight ?? 0;
  }

  scaleThatFits(camera, low, high, middle) {
    const { right, up } = frameOf(camera);
    let wide = 0;
    let tall = 0;
    for (let corner = 0; corner < 8; corner += 1) {
      const d = [0, 1, 2].map((c) => ((corner >> c) & 1 ? high[c] : low[c]) - middle[c]);
      wide = Math.max(wide, Math.abs(d[0] * right[0] + d[1] * right[1] + d[2] * right[2]));
      tall = Math.max(tall, Math.abs(d[0] * up[0] + d[1] * up[1] + d[2] * up[2]));
    }
    const { clientWidth, clientHeight } = this.container;
    // Below the legend, and as far from the lower edge.
    const free = Math.max(0.4 * clientHeight, clientHeight - 2 * (this.legendHeight() + 12));
    return (
      1.05 *
      Math.max((tall * clientHeight) / Math.max(1, free), (wide * clientHeight) / Math.max(1, clientWidth), 1e-12)
    );
  }

  // By keys: x and y in units of the picture's height, turned in space and shifted in the plane.
  nudge(x, y, zoom) {
    const camera = this.renderer.getActiveCamera();
    if (zoom) camera.setParallelScale(camera.getParallelScale() / zoom);
    else if (this.mesh.flat) {
      const by = 2 * camera.getParallelScale();
      const shift = (place) => [place[0] + x * by, place[1] + y * by, place[2]];
      camera.setFocalPoint(...shift(camera.getFocalPoint()));
      camera.setPosition(...shift(camera.getPosition()));
    } else {
      camera.azimuth(-90 * x);
      camera.elevation(-90 * y);
      camera.orthogonalizeViewUp();
    }
    this.renderer.resetCameraClippingRange();
    this.draw();
  }

  resize() {
    const { clientWidth, clientHeight } = this.container;
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    this.view.setSize(Math.max(1, Math.floor(clientWidth * ratio)), Math.max(1, Math.floor(clientHeight * ratio)));
    if (!this.drawn) return;
    if (this.isFitted()) this.fit(); // the scale is one of the height: a narrower picture would cut the sides off
    this.draw();
  }

  draw() {
    this.drawn = true;
    this.window.render();
  }
}

// What is to the right and up on the screen.
export function frameOf(camera) {
  const d = camera.getDirectionOfProjection();
  const v = camera.getViewUp();
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const raw = cross(d, v);
  const length = Math.hypot(...raw) || 1;
  const right = raw.map((value) => value / length);
  return { right, up: cross(right, d) };
}
