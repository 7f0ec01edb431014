"""tact in ParaView: a filter that finds where surfaces touch and cross, over time. tact_paraview.xml lists it."""

import numpy as np
import tact
from vtkmodules.util import numpy_support
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkCompositeDataSet, vtkDataObject, vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm, vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter


FLAT = {5, 7, 9}  # triangles, polygons, quadrilaterals, as VTK numbers the kinds of cells


class Trouble(Exception):
    """What the user is told."""


class Surface:
    """A polygonal block of the input, and the bodies in it."""

    def __init__(self, name, data):
        self.name, self.data = name, data
        if data.GetNumberOfStrips():
            raise Trouble(f"{name} has triangle strips: apply the filter Triangulate before")
        self.points = numpy_support.vtk_to_numpy(data.GetPoints().GetData()) if data.GetNumberOfPoints() else np.empty((0, 3))
        polygons = data.GetPolys()
        offsets = numpy_support.vtk_to_numpy(polygons.GetOffsetsArray())
        self.sizes, corners = np.diff(offsets).astype(np.int32), numpy_support.vtk_to_numpy(polygons.GetConnectivityArray()).astype(np.int32)
        self.key = (self.sizes.tobytes(), corners.tobytes(), len(self.points))
        self.corners = corners

    def facets(self):
        """Triangles, and the polygon of each; split as the program splits them."""
        if (self.sizes == 3).all():
            return self.corners.reshape(-1, 3), np.arange(len(self.sizes))
        triangles = tact._tact._split_polygons(self.name, self.points, self.sizes, self.corners)
        return triangles, np.repeat(np.arange(len(self.sizes)), self.sizes - 2)

    def body_numbers(self):
        """Of which body each point is, where the file tells; else None."""
        array = self.data.GetPointData().GetArray("body")
        if array is None or array.GetNumberOfComponents() != 1:
            return None
        numbers = numpy_support.vtk_to_numpy(array)
        return numbers if np.issubdtype(numbers.dtype, np.integer) and len(np.unique(numbers)) > 1 else None


class Body:
    """A part of a surface: its vertices and facets by their numbers there."""

    def __init__(self, name, surface, vertices, facets, polygons):
        self.name, self.surface, self.vertices, self.polygons = name, surface, vertices, polygons
        number = np.full(len(surface.points), -1, np.int32)
        number[vertices] = np.arange(len(vertices), dtype=np.int32)
        self.facets = number[facets]

    def positions(self, surface):
        return np.ascontiguousarray(surface.points[self.vertices], float)


def bodies_of(surfaces):
    bodies = []
    for place, surface in enumerate(surfaces):
        facets, polygons = surface.facets()
        numbers = surface.body_numbers()
        if numbers is None:
            bodies.append(Body(surface.name, place_of(surfaces, place), np.arange(len(surface.points)), facets, polygons))
            continue
        for number in np.unique(numbers):
            inside = numbers[facets] == number
            if (inside.any(axis=1) != inside.all(axis=1)).any():
                raise Trouble(f"{surface.name}: a polygon joins points of two bodies")
            mine = inside.all(axis=1)
            bodies.append(Body(f"{surface.name}:{number}", place_of(surfaces, place), np.flatnonzero(numbers == number), facets[mine], polygons[mine]))
    return bodies


def place_of(surfaces, place):
    surface = surfaces[place]
    surface.place = place
    return surface


def words_of(text):
    """{body: what add_body() takes}, of lines such as `cloth: sheet, margin 0.004, self_contact`."""
    said = {}
    for number, line in enumerate(text.splitlines(), 1):
        if not line.strip():
            continue
        name, colon, words = line.rpartition(": ")
        if not colon:
            raise Trouble(f"Bodies, line {number}: expected `name: words`, found {line.strip()!r}")
        settings = said.setdefault(name.strip(), {})
        for word in (word.strip() for word in words.split(",")):
            if word in ("closed", "sheet"):
                settings["surface"] = getattr(tact.Surface, word)
            elif word in ("self_contact", "no self_contact"):
                settings["self_contact"] = word == "self_contact"
            elif word.startswith("margin "):
                try:
                    settings["margin"] = float(word[7:])
                except ValueError:
                    raise Trouble(f"Bodies, line {number}: {word[7:]!r} is not a length in metres") from None
            else:
                raise Trouble(f"Bodies, line {number}: {word!r} is none of closed, sheet, margin, self_contact")
    return said


def polygons_of(data, name):
    """The surface of a block: itself, or that of its cells."""
    if data.IsA("vtkPolyData"):
        return data
    if not data.IsA("vtkDataSet"):
        raise Trouble(f"{name} is a {data.GetClassName()}, which has no surface")
    if data.IsA("vtkUnstructuredGrid") and data.GetNumberOfCells() and set(numpy_support.vtk_to_numpy(data.GetCellTypesArray()).tolist()) <= FLAT:
        surface = vtkPolyData()  # points and cells keep their numbers, which they would not below
        surface.SetPoints(data.GetPoints())
        surface.SetPolys(data.GetCells())
        surface.GetPointData().ShallowCopy(data.GetPointData())
        surface.GetCellData().ShallowCopy(data.GetCellData())
        return surface
    filter = vtkDataSetSurfaceFilter()
    filter.SetInputData(data)
    filter.Update()
    surface = vtkPolyData()
    surface.ShallowCopy(filter.GetOutput())
    return surface


def surfaces_of(inputs):
    """All blocks with polygons, with names that differ."""
    found, taken = [], {}

    def add(name, data):
        taken[name] = taken.get(name, 0) + 1
        own = name if taken[name] == 1 else f"{name}#{taken[name]}"
        polygons = polygons_of(data, own)
        if polygons.GetNumberOfPolys() or polygons.GetNumberOfStrips():
            found.append(Surface(own, polygons))

    for number, data in enumerate(inputs):
        if not data.IsA("vtkCompositeDataSet"):
            add(f"input {number}", data)
            continue
        blocks = data.NewTreeIterator() if hasattr(data, "NewTreeIterator") else data.NewIterator()
        blocks.InitTraversal()
        while not blocks.IsDoneWithTraversal():
            has_name = blocks.HasCurrentMetaData() and blocks.GetCurrentMetaData().Has(vtkCompositeDataSet.NAME())
            name = blocks.GetCurrentMetaData().Get(vtkCompositeDataSet.NAME()) if has_name else f"block {blocks.GetCurrentFlatIndex()}"
            add(name, blocks.GetCurrentDataObject())
            blocks.GoToNextItem()
    return found


class Run:
    """A world that is stepped in the order of the time steps; anew where they are jumped."""

    def __init__(self):
        self.world, self.step, self.keys, self.words = None, None, None, None

    def find(self, surfaces, words, settings, step, impacts):
        """What meets at time step number `step`, and whether it carries on from the step before."""
        keys = [(surface.name, surface.key) for surface in surfaces]
        carries = self.world is not None and step == self.step + 1 and keys == self.keys and words == self.words
        if carries:
            self.world.set_positions({id: body.positions(surfaces[body.surface.place]) for id, body in zip(self.ids, self.bodies)})
        else:
            self._begin(surfaces, words, settings)
        motion = self.world.detect_motion() if impacts and carries else None
        report = self.world.detect()
        self.step, self.keys, self.words = step, keys, words
        return tact.CheckFrame(step, None, [], report, motion, self.sizes), carries

    def _begin(self, surfaces, words, settings):
        default, said = words
        self.bodies = bodies_of(surfaces)
        unknown = set(said) - {body.name for body in self.bodies}
        if unknown:
            raise Trouble(f"Bodies: no body is called {sorted(unknown)[0]}; there are: {', '.join(body.name for body in self.bodies)}")
        self.world, self.ids = tact.World(settings), []
        for body in self.bodies:
            given = {**default, **said.get(body.name, {})}
            self.ids.append(self.world.add_body(body.positions(surfaces[body.surface.place]), body.facets, name=body.name, **given))
        self.sizes = [(len(body.vertices), len(body.facets)) for body in self.bodies]


def add_array(fields, name, values):
    array = numpy_support.numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    fields.AddArray(array)


def add_words(fields, name, words):
    array = vtkStringArray()
    array.SetName(name)
    for word in words:
        array.InsertNextValue(word)
    fields.AddArray(array)


def show_points(frame, run, surfaces, output):
    """A vertex a contact point, on the surface of body a."""
    points = frame.points
    places = np.zeros((len(points), 3))
    for body, one in enumerate(run.bodies):
        here = points.bodies[:, 0] == body
        corners = one.positions(surfaces[one.surface.place])[np.maximum(points.a_vertices[here], 0)]
        weights = np.where(points.a_vertices[here] >= 0, points.a_weights[here], 0.0)
        places[here] = (corners * weights[:, :, None]).sum(axis=1)
    shown = vtkPoints()
    shown.SetData(numpy_support.numpy_to_vtk(places, deep=True))
    cells = vtkCellArray()
    numbers = numpy_support.numpy_to_vtkIdTypeArray(np.arange(len(points) + 1, dtype=np.int64), deep=True)
    cells.SetData(numbers, numpy_support.numpy_to_vtkIdTypeArray(np.arange(len(points), dtype=np.int64), deep=True))
    output.SetPoints(shown)
    output.SetVerts(cells)
    for name, values in (("gap", points.gaps), ("normal", points.normals), ("bodies", points.bodies), ("id", points.ids), ("patch", points.patch_ids), ("kind", points.kinds), ("minimum", points.minima)):
        add_array(output.GetPointData(), name, values)


def show_surfaces(frame, run, surfaces, output):
    """The input's blocks with tact_gap, NaN where no contact point is, and tact_crossing."""
    output.SetNumberOfBlocks(len(surfaces))
    for place, surface in enumerate(surfaces):
        shown = vtkPolyData()
        shown.ShallowCopy(surface.data)
        gaps = np.full(len(surface.points), np.nan)
        crossing = np.zeros(shown.GetNumberOfCells(), np.uint8)
        first = shown.GetNumberOfVerts() + shown.GetNumberOfLines()  # polygons come after them
        for body, one in enumerate(run.bodies):
            if one.surface.place == place:
                of_body = frame.gaps(body)
                gaps[one.vertices] = np.where(np.isinf(of_body), np.nan, of_body)
                crossing[first + one.polygons[frame.crossing(body)]] = 1
        add_array(shown.GetPointData(), "tact_gap", gaps)
        add_array(shown.GetCellData(), "tact_crossing", crossing)
        output.SetBlock(place, shown)
        output.GetMetaData(place).Set(vtkCompositeDataSet.NAME(), surface.name)


def show_sums(frame, run, carries, fields):
    """What holds for the whole step."""
    add_words(fields, "tact_bodies", [body.name for body in run.bodies])
    add_words(fields, "tact_hash", [frame.hash])
    add_array(fields, "tact_carried", np.array([carries], np.uint8))
    add_array(fields, "tact_facet_pairs", np.array([len(frame.facet_pairs)]))
    if frame.impacts is not None:
        add_array(fields, "tact_impacts", np.array([len(frame.impacts)]))
        add_array(fields, "tact_first_time", np.array([frame.impacts.first_time]))


ACCURACIES = ("hulls", "paper", "exact")
SURFACES = ("closed", "sheet")


class TactContacts(VTKPythonAlgorithmBase):
    """Where two or more surfaces touch and cross, over time: contact points, and the surfaces with tact_gap and tact_crossing."""

    def __init__(self):
        super().__init__(nInputPorts=1, nOutputPorts=2, outputType="vtkPolyData")
        self._surface, self._margin, self._self_contact, self._lines = 0, 0.0, 0, ""
        self._accuracy, self._threads, self._impacts = 2, 0, 0
        self._run = Run()

    def FillInputPortInformation(self, port, info):
        info.Set(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet")
        info.Append(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet")
        info.Set(vtkAlgorithm.INPUT_IS_REPEATABLE(), 1)
        return 1

    def FillOutputPortInformation(self, port, info):
        info.Set(vtkDataObject.DATA_TYPE_NAME(), ("vtkPolyData", "vtkMultiBlockDataSet")[port])
        return 1

    def _set(self, name, value):
        if getattr(self, name) != value:
            setattr(self, name, value)
            self._run = Run()
            self.Modified()

    def SetSurface(self, value):
        self._set("_surface", int(value))

    def SetMargin(self, value):
        self._set("_margin", float(value))

    def SetSelfContact(self, value):
        self._set("_self_contact", int(value))

    def SetBodies(self, value):
        self._set("_lines", value or "")

    def SetImpacts(self, value):
        self._set("_impacts", int(value))

    def SetAccuracy(self, value):
        self._set("_accuracy", int(value))

    def SetThreads(self, value):
        self._set("_threads", int(value))

    def _step_of(self, input_info, output_info):
        """The number of the time step that is asked for."""
        pipeline = vtkStreamingDemandDrivenPipeline
        if not input_info.Has(pipeline.TIME_STEPS()) or not output_info.Has(pipeline.UPDATE_TIME_STEP()):
            return 0
        times = np.array([input_info.Get(pipeline.TIME_STEPS(), number) for number in range(input_info.Length(pipeline.TIME_STEPS()))])
        return int(np.abs(times - output_info.Get(pipeline.UPDATE_TIME_STEP())).argmin())

    def RequestData(self, request, inputs, outputs):
        port = max(request.Get(vtkStreamingDemandDrivenPipeline.FROM_OUTPUT_PORT()), 0)
        points, blocks = vtkPolyData.GetData(outputs, 0), vtkMultiBlockDataSet.GetData(outputs, 1)
        connections = [inputs[0].GetInformationObject(number) for number in range(inputs[0].GetNumberOfInformationObjects())]
        try:
            surfaces = surfaces_of([vtkDataObject.GetData(info) for info in connections])
            if not surfaces:
                raise Trouble("the input has no polygons")
            default = {"surface": getattr(tact.Surface, SURFACES[self._surface]), "margin": self._margin, "self_contact": bool(self._self_contact)}
            settings = tact.Settings(threads=self._threads, accuracy=getattr(tact.Accuracy, ACCURACIES[self._accuracy]), points=True, patches=True)
            step = self._step_of(connections[0], outputs.GetInformationObject(port))
            frame, carries = self._run.find(surfaces, (default, words_of(self._lines)), settings, step, bool(self._impacts))
        except (Trouble, ValueError, tact.Error) as trouble:
            self._run = Run()
            raise RuntimeError(f"tact: {trouble}") from None  # which ParaView shows among its messages
        show_points(frame, self._run, surfaces, points)
        show_surfaces(frame, self._run, surfaces, blocks)
        for output in (points, blocks):
            show_sums(frame, self._run, carries, output.GetFieldData())
        return 1
