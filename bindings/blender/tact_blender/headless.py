"""The check without a window, as JSON."""

import json
import sys


def check(objects=None, *, collection=None, frames=None, accuracy=None, points=False, impacts=False, threads=0, surfaces=None, margins=None, selves=(), out=None):
    """Checks objects of the open file, by name, and prints the JSON that `tact check` prints; returns it, too.

    Without `objects` and `collection` all that has faces and can be seen is checked. `frames`: numbers of frames; None for the
    one that is set. What objects are - closed or sheet, margin, self-contact - is what the file holds, or what `surfaces` and
    `margins` say by name, and `selves`. `out`: a file to write to in place of standard output. Errors: ValueError.
    """
    import bpy

    from . import properties, session
    from .checker import frame_json, head_json

    registered = hasattr(bpy.types.Object, "tact")
    if not registered:  # the settings that the file holds can be read
        properties.register()
    context = bpy.context
    here = context.scene.frame_current
    try:
        if objects is None and collection is None:
            objects = sorted(one.name for one in context.scene.objects if one.visible_get() and one.type == "MESH")
        run = session.Run(context, session.chosen_objects(context, objects, collection), points=points, threads=threads, **({"accuracy": accuracy} if accuracy else {}))
        run.checker.settings = _with(session.settings_of, surfaces or {}, margins or {}, selves)
        found = []
        for place, frame in enumerate([here] if frames is None else frames):
            run.step(frame, impacts=impacts and place > 0)
            if not found:
                head = head_json(run.checker)
            for text in run.told:
                print(f"frame {frame}: {text}", file=sys.stderr)
            found.append(frame_json(frame, run.checker))
    except session.Trouble as trouble:
        raise ValueError(str(trouble)) from trouble
    finally:
        context.scene.frame_set(here)
        if not registered:
            properties.unregister()
    whole = {**head, "frames": found}
    if out is None:
        print(json.dumps(whole))
    else:
        with open(out, "w", encoding="utf-8") as file:
            json.dump(whole, file)
    return whole


def _with(settings_of, surfaces, margins, selves):
    import tact

    def settings(surface):
        given, name = settings_of(surface), surface.object.name
        if name in surfaces:
            given["surface"] = getattr(tact.Surface, surfaces[name])
        if name in margins:
            given["margin"] = margins[name]
        if name in selves:
            given["self_contact"] = True
        return given

    return settings
