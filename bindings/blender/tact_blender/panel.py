"""The sidebar of the 3D view."""

import textwrap

import bpy

WIDTH = 28  # letters that fit into a line of the sidebar as wide as Blender opens it


def _columns(layout):
    """Three columns that fit into the sidebar as wide as Blender opens it: frame, pairs, gap."""
    split = layout.split(factor=0.36)
    return split.row(), split.split(factor=0.42)


class TACT_UL_frames(bpy.types.UIList):
    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index):
        frame, numbers = _columns(layout)
        frame.label(text=str(item.frame), icon="ERROR" if item.facet_pairs or item.impacts else "CHECKMARK")
        numbers.label(text=str(item.facet_pairs))
        numbers.label(text=f"{item.least_gap:.2g}" if item.points else "")


class _InSidebar(bpy.types.Panel):
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "tact"


class TACT_PT_check(_InSidebar):
    bl_label = "Contacts"

    def draw(self, context):
        layout, options = self.layout, context.scene.tact
        layout.use_property_split = True
        layout.prop(options, "source")
        if options.source == "collection":
            layout.prop(options, "collection")
        layout.prop(options, "accuracy")
        layout.use_property_split = False
        layout.prop(options, "impacts")
        column = layout.column(align=True)
        for button in ("check_frame", "check_motion", "check_range"):
            column.operator(f"tact.{button}")


class TACT_PT_object(_InSidebar):
    bl_label = "This Object"

    @classmethod
    def poll(cls, context):
        return context.object is not None

    def draw(self, context):
        layout, options = self.layout, context.object.tact
        layout.use_property_split = True
        layout.label(text=context.object.name, icon="OBJECT_DATA")
        for name in ("surface", "margin"):
            layout.prop(options, name)
        layout.use_property_split = False
        layout.prop(options, "self_contact")


class TACT_PT_found(_InSidebar):
    bl_label = "Found"

    def draw(self, context):
        layout, results = self.layout, context.window_manager.tact
        frame, numbers = _columns(layout)
        for column, text in ((frame, "Frame"), (numbers, "Pairs"), (numbers, "Gap, m")):
            column.label(text=text)
        layout.template_list("TACT_UL_frames", "", results, "frames", results, "active", rows=4)
        row = next((one for one in results.frames if one.frame == context.scene.frame_current), None)
        if row is None:
            layout.label(text="This frame is not checked")
        else:
            lines = [f"{row.facet_pairs} pairs of faces meet", f"{row.self_pairs} of them within one object" if row.self_pairs else "", f"{row.impacts} impacts, the first at {row.first_time:.4g}" if row.impacts else ""]
            lines += [f"{row.points} contact points", f"the least gap {row.least_gap:.6g} m"] if row.points else []
            lines += [f"crossing: {row.crossing}" if row.crossing else "", row.told]
            column = layout.column(align=True)
            for line in filter(None, lines):
                for part in textwrap.wrap(line, WIDTH):
                    column.label(text=part)
        layout.prop(results, "shown")
        column = layout.column(align=True)
        for button in ("select_crossing", "write_attributes", "untangle"):
            column.operator(f"tact.{button}")


CLASSES = (TACT_UL_frames, TACT_PT_check, TACT_PT_object, TACT_PT_found)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)


def unregister():
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
