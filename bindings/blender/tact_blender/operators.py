"""The buttons."""

import time

import bpy
from bpy.props import FloatProperty, IntProperty

from . import changes, session

MOMENT = 0.1  # seconds between looks at the keyboard: Esc feels immediate


class _Checking(bpy.types.Operator):
    """What all buttons share: trouble is told in Blender's way, and ends in CANCELLED."""

    def told(self, texts):
        for text in texts:
            self.report({"WARNING"}, text)

    def execute(self, context):
        try:
            return self.run(context)
        except session.Trouble as trouble:
            self.report({"ERROR"}, str(trouble))
            return {"CANCELLED"}


class TACT_OT_check_frame(_Checking):
    bl_idname = "tact.check_frame"
    bl_label = "Check This Frame"
    bl_description = "Finds which faces of the chosen objects meet now"

    def run(self, context):
        run = session.Run(context, session.chosen_objects(context))
        found = run.step()
        session.list_frame(context, found, run.told)
        self.told(run.told)
        self.report({"INFO"}, session.sentence(found))
        return {"FINISHED"}


class TACT_OT_check_motion(_Checking):
    bl_idname = "tact.check_motion"
    bl_label = "Check Motion to This Frame"
    bl_description = "Finds what meets between the frame before and this one, every vertex moving straight"

    def run(self, context):
        run, here = session.Run(context, session.chosen_objects(context)), context.scene.frame_current
        try:
            run.step(here - 1)
        finally:
            context.scene.frame_set(here)
        found = run.step(impacts=True)
        session.list_frame(context, found, run.told)
        self.told(run.told)
        self.report({"INFO"}, session.sentence(found))
        return {"FINISHED"}


class TACT_OT_check_range(_Checking):
    bl_idname = "tact.check_range"
    bl_label = "Check the Range"
    bl_description = "Checks every frame from the scene's start to its end. Esc ends it"

    def begin(self, context):
        scene = context.scene
        self.work = session.Run(context, session.chosen_objects(context))
        self.here, self.frames = scene.frame_current, list(range(scene.frame_start, scene.frame_end + 1, scene.frame_step))
        self.done, self.meeting = 0, 0
        context.window_manager.tact.frames.clear()
        session.found_in.clear()
        context.window_manager.progress_begin(0, len(self.frames))

    def one(self, context):
        found = self.work.step(self.frames[self.done], impacts=context.scene.tact.impacts and self.done > 0)
        session.list_frame(context, found, self.work.told)
        self.done += 1
        self.meeting += found.facet_pairs > 0
        context.window_manager.progress_update(self.done)

    def some(self, context):
        """As many frames as a moment takes: Blender draws its window after each call, which may take longer than a frame."""
        began = time.monotonic()
        while True:
            self.one(context)
            if self.done == len(self.frames) or time.monotonic() - began > MOMENT:
                return

    def end(self, context, cancelled=False):
        context.window_manager.progress_end()
        context.scene.frame_set(self.here)
        self.told(self.work.told)
        text = f"faces meet in {self.meeting} of {self.done} frames"
        self.report({"WARNING"} if cancelled else {"INFO"}, f"cancelled after {self.done} of {len(self.frames)} frames: {text}" if cancelled else text)

    def run(self, context):
        self.begin(context)
        try:
            while self.done < len(self.frames):
                self.one(context)
        finally:
            self.end(context, self.done < len(self.frames))
        return {"FINISHED"}

    def invoke(self, context, event):
        try:
            self.begin(context)
        except session.Trouble as trouble:
            self.report({"ERROR"}, str(trouble))
            return {"CANCELLED"}
        self.timer = context.window_manager.event_timer_add(0.0, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type not in {"TIMER", "ESC"}:
            return {"RUNNING_MODAL"}
        cancelled = event.type == "ESC"
        try:
            if not cancelled:
                self.some(context)
                context.workspace.status_text_set(f"tact: frame {self.done} of {len(self.frames)}; Esc ends it")
        except session.Trouble as trouble:
            self.report({"ERROR"}, str(trouble))
            cancelled = True
        if not cancelled and self.done < len(self.frames):
            return {"RUNNING_MODAL"}
        context.window_manager.event_timer_remove(self.timer)
        context.workspace.status_text_set(None)
        self.end(context, cancelled)
        return {"CANCELLED"} if cancelled else {"FINISHED"}


class _OfThisFrame(_Checking):
    """What needs what was found in the frame that is shown."""

    @classmethod
    def poll(cls, context):
        if context.mode != "OBJECT":
            cls.poll_message_set("in object mode alone")
            return False
        if session.found_now(context) is None:
            cls.poll_message_set("check this frame first")
            return False
        return True


class TACT_OT_select_crossing(_OfThisFrame):
    bl_idname = "tact.select_crossing"
    bl_label = "Select What Crosses"
    bl_description = "Selects the faces that meet others, to be seen in edit mode"
    bl_options = {"REGISTER", "UNDO"}

    def run(self, context):
        count, told = changes.select_crossing(session.found_now(context))
        self.told(told)
        self.report({"INFO"}, f"{count} {'face is' if count == 1 else 'faces are'} selected")
        return {"FINISHED"}


class TACT_OT_write_attributes(_OfThisFrame):
    bl_idname = "tact.write_attributes"
    bl_label = "Write Attributes"
    bl_description = "Gives the meshes tact_gap, metres at vertices, and tact_crossing, of faces, for shaders and geometry nodes"
    bl_options = {"REGISTER", "UNDO"}

    def run(self, context):
        count, told = changes.write_attributes(session.found_now(context))
        self.told(told)
        self.report({"INFO"}, f"{count} {'mesh has' if count == 1 else 'meshes have'} the attributes")
        return {"FINISHED"}


class TACT_OT_untangle(_Checking):
    bl_idname = "tact.untangle"
    bl_label = "Untangle Selected"
    bl_description = "Pushes the vertices of the selected objects out of what they cross, by contact points, into a shape key"
    bl_options = {"REGISTER", "UNDO"}

    passes: IntProperty(name="Passes", default=8, min=1, max=100)
    clearance: FloatProperty(name="Clearance", description="How far apart surfaces are to be in the end", default=0.001, min=0.0, unit="LENGTH", precision=4)

    @classmethod
    def poll(cls, context):
        if context.mode != "OBJECT":
            cls.poll_message_set("in object mode alone")
        return context.mode == "OBJECT"

    def run(self, context):
        run = session.Run(context, session.chosen_objects(context))
        first, last, passes = changes.untangle(run, list(context.view_layer.objects.selected), self.passes, self.clearance)
        session.list_frame(context, last, run.told)
        if passes == 0:
            self.told(run.told)
            self.report({"WARNING"}, "nothing was moved: " + session.sentence(last))
            return {"FINISHED"}
        self.report({"INFO"}, f"{passes} passes: {first.facet_pairs} pairs of faces met, {last.facet_pairs} do now")
        return {"FINISHED"}


CLASSES = (TACT_OT_check_frame, TACT_OT_check_motion, TACT_OT_check_range, TACT_OT_select_crossing, TACT_OT_write_attributes, TACT_OT_untangle)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)


def unregister():
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
