"""Draws the picture of the page on ParaView, by the filter itself.

usage: PYTHONPATH=bindings/paraview:... xvfb-run -a pvpython docs/paraview_picture.py PICTURE.png
"""

import pathlib
import sys

from paraview import simple

simple.LoadPlugin(str(pathlib.Path(__file__).resolve().parents[1] / "bindings/paraview/tact_paraview.xml"), ns=vars(simple))
sheet = simple.Plane(XResolution=30, YResolution=30, Origin=[-1, -1, 0.32], Point1=[1, -1, 0.32], Point2=[-1, 1, 0.32])
ball = simple.Sphere(Radius=0.5, ThetaResolution=32, PhiResolution=16, Center=[0.05, 0.03, 0.1])
contacts = simple.TactContacts(Input=[ball, sheet], Margin=0.02, Bodies="input 1: sheet")
contacts.UpdatePipeline()

view = simple.CreateRenderView(ViewSize=[1000, 600], Background=[1, 1, 1], UseColorPaletteForBackground=0, OrientationAxesVisibility=0)
shown = simple.Show(simple.OutputPort(contacts, 1), view, Representation="Surface With Edges", EdgeColor=[0.5, 0.55, 0.6])
simple.ColorBy(shown, ("CELLS", "tact_crossing"))
simple.GetColorTransferFunction("tact_crossing").RGBPoints = [0.0, 0.78, 0.84, 0.9, 1.0, 0.93, 0.16, 0.12]
glyphs = simple.Glyph(Input=simple.OutputPort(contacts, 0), GlyphType="Arrow", ScaleFactor=0.12, GlyphMode="All Points")
glyphs.OrientationArray = ["POINTS", "normal"]
glyphs.UpdatePipeline()
arrows = simple.Show(glyphs, view)
simple.ColorBy(arrows, ("POINTS", "gap"))
arrows.SetScalarBarVisibility(view, True)
bar = simple.GetScalarBar(simple.GetColorTransferFunction("gap"), view)
bar.Title, bar.ComponentTitle, bar.TitleColor, bar.LabelColor = "gap, m", "", [0, 0, 0], [0, 0, 0]
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [1.3, -2.2, 1.5], [0.05, 0, 0.25], [0, 0, 1]
simple.SaveScreenshot(sys.argv[1], view)
