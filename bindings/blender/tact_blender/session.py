"""What the add-on does, without buttons: which objects, a step, the range, and what was found last."""

import tact

from .checker import Checker
from .surfaces import key_of, object_of, shown_surfaces

found_in = {}  # scene's name and frame: what was found there, of this session


class Trouble(Exception):
    """What a user has to be told: there is nothing to check, say."""


def chosen_objects(context, names=None, collection=None):
    """The objects to be checked, by name. Errors: Trouble."""
    import bpy

    options = context.scene.tact
    if names is not None:
        missing = [name for name in names if name not in context.scene.objects]
        if missing:
            raise Trouble(f"the scene has no object called {missing[0]}")
        objects = [context.scene.objects[name] for name in names]
    elif collection is not None or options.source == "collection":
        if collection is not None and collection not in bpy.data.collections:
            raise Trouble(f"no collection is called {collection}")
        group = bpy.data.collections[collection] if collection is not None else options.collection
        if group is None:
            raise Trouble("choose the collection that is to be checked")
        objects = sorted(group.all_objects, key=lambda object: object.name)
    else:
        objects = sorted(context.view_layer.objects.selected, key=lambda object: object.name)
    if not objects:
        raise Trouble("no object is selected")
    return objects


def settings_of(surface):
    """What add_body() takes of an object besides its mesh."""
    options = surface.object.tact
    return {"surface": getattr(tact.Surface, options.surface), "margin": options.margin, "self_contact": options.self_contact}


class Run:
    """A world over frames of a scene."""

    def __init__(self, context, objects, **settings):
        self.context, self.keys = context, [key_of(object) for object in objects]
        self.checker = Checker(settings_of, **{"accuracy": context.scene.tact.accuracy, **settings})
        self.told, self.kept = [], {}

    def step(self, frame=None, *, impacts=False):
        """Goes to a frame, if one is given, and checks it. Errors: Trouble."""
        if frame is not None:
            self.context.scene.frame_set(frame)
        objects = [object_of(key) for key in self.keys]
        if None in objects:
            raise Trouble(f"{self.keys[objects.index(None)][0]} is gone")
        surfaces, self.told = shown_surfaces(self.context.evaluated_depsgraph_get(), objects, self.kept)
        if not surfaces:
            raise Trouble("; ".join(self.told) or "nothing that was chosen has faces")
        try:
            found = self.checker.step(surfaces, impacts=impacts)
        except tact.Error as error:
            raise Trouble(str(error)) from error
        if found.restarted:
            self.told.append("other faces than in the frame before: nothing was carried on")
        found_in[_here(self.context)] = found
        return found


def _here(context):
    return context.scene.name, context.scene.frame_current


def list_frame(context, found, told):
    """Puts a frame into the list, in order, or in place of what was found there before."""
    results, number = context.window_manager.tact, context.scene.frame_current
    place = next((i for i, one in enumerate(results.frames) if one.frame >= number), len(results.frames))
    if place == len(results.frames) or results.frames[place].frame != number:
        results.frames.add()
        results.frames.move(len(results.frames) - 1, place)
    row = results.frames[place]
    row.frame, row.facet_pairs, row.self_pairs = number, found.facet_pairs, found.self_pairs
    row.points, row.least_gap = len(found.gaps), found.least_gap or 0.0
    row.impacts, row.first_time = found.impacts, -1.0 if found.first_time is None else found.first_time
    row.crossing, row.told = ", ".join(found.crossing_names()), "; ".join(told)
    results["active"] = place  # without going there: it is the frame that is shown
    return row


def found_now(context):
    """What was found in the frame that is shown, or None."""
    return found_in.get(_here(context))


def sentence(found):
    """What was found, in words."""
    def count(n, one, many):
        return f"{n} {one if n == 1 else many}"

    words = [count(found.facet_pairs, "pair of faces meets", "pairs of faces meet")] if found.facet_pairs else ["no faces meet"]
    if found.self_pairs:
        words.append(f"{found.self_pairs} of them within one object")
    if len(found.gaps):
        words.append(f"{count(len(found.gaps), 'contact point', 'contact points')}, the least gap {found.least_gap:.6g} m")
    if found.impacts:
        words.append(f"{count(found.impacts, 'impact', 'impacts')} on the way, the first at {found.first_time:.4g}")
    return "; ".join(words)
