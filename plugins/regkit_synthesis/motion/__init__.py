"""Motion of a human figure: where it comes from, and how it arrives on any rigged body.

A *source* (a clip, a BVH file, a glTF animation, keyframes) has joints with names of its own, and
so have the bones of a *body*. Neither knows the other: a map of the source and a map of the body,
both YAML files, say which joint of one human ``figure`` each of them is.
"""
