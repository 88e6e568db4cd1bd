"""Small drawings, each of which says one thing of how SVG is shown."""

import re

__all__ = ["CASES", "HEAD", "PAGE", "drawing", "size"]

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
PAGE = 'width="100mm" height="100mm" viewBox="0 0 100 100"'

#: Thin lines, however they are scaled, so that a picture shows where they are.
THIN = 'stroke-width="2" stroke-linejoin="round"><style>*{vector-effect:non-scaling-stroke}</style>'


def drawing(body, *, pen=True, page=PAGE):
    """A document of a page of 100 mm; with a pen, all that says nothing else is a black line."""
    paint = 'fill="none" stroke="#000"' if pen else ""
    return f"{HEAD} {page} {paint} {THIN}{body}</svg>"


def size(text):
    """Width and height of a document's page, in mm."""
    found = re.search(r'width="(\d+)mm" height="(\d+)mm"', text)
    return float(found[1]), float(found[2])


CASES = {
    "class": drawing(
        "<style>.a{fill:none;stroke:#000}.b{display:none}</style>"
        '<path class="a" d="M10 10H90V90H10Z"/><path class="a b" d="M10 10L90 90"/>',
        pen=False,
    ),
    "specificity": drawing(
        "<style>#x{stroke:#000}path{stroke:none;fill:none}.q{stroke:none}g .q.r{stroke:#00f}"
        '</style><g><path id="x" class="q" d="M10 10H90"/><path class="q r" d="M10 20H90"/>'
        '<path class="q" stroke="#000" d="M10 30H90"/>'
        '<path class="q" style="stroke:#000" d="M10 40H90"/></g>',
        pen=False,
    ),
    "important": drawing(
        "<style>.a{stroke:#000;display:none!important}.b{stroke:none!important}</style>"
        '<path d="M10 10L90 80" class="a" style="display:inline"/>'
        '<path d="M10 20H90" stroke="#000"/>'
        '<path d="M10 40H90" class="b" style="stroke:#000"/>',
        pen=False,
    ),
    "media": drawing(
        "<style>@media print{.a{display:none}}@media screen{.b{display:none}}@media "
        "(prefers-color-scheme: dark){.a{display:none}}@media "
        "(prefers-color-scheme:light){.c{display:none}}</style><g>"
        '<path class="a" d="M10 10H90"/><path class="b" d="M10 20H90"/>'
        '<path class="c" d="M10 30H90"/></g>',
    ),
    "visibility": drawing(
        '<g visibility="hidden"><path d="M10 10H90"/>'
        '<path style="visibility:visible" d="M10 20H90V60"/><g visibility="visible">'
        '<path d="M10 70H80"/><path visibility="collapse" d="M10 80H80"/></g></g>',
    ),
    "opacity0": drawing(
        '<g><g opacity="0"><path opacity="1" d="M10 10H90"/></g>'
        '<path d="M10 20H90" style="opacity:0%"/><path d="M10 30H90"/>'
        '<path d="M10 40H90" stroke-opacity="0"/>'
        '<path d="M10 50H50V90" stroke="none" fill="#00f" fill-opacity="0"/></g>',
    ),
    "transparent": drawing(
        '<rect x="10" y="10" width="20" height="20" fill="transparent"/>'
        '<rect x="40" y="10" width="20" height="20" fill="rgba(0,0,0,0)"/>'
        '<rect x="70" y="10" width="20" height="20" fill="#00000000"/>'
        '<rect x="10" y="50" width="20" height="20" fill="rgb(255 0 0 / 50%)"/>',
        pen=False,
    ),
    "unpainted": drawing(
        '<rect x="10" y="10" width="20" height="20" fill="none"/><path d="M50 10H90"/>'
        '<line x1="50" y1="20" x2="90" y2="30"/>'
        '<line x1="50" y1="30" x2="90" y2="40" stroke="#000"/>'
        '<rect x="10" y="50" width="20" height="20" fill="none" stroke="#000" '
        'stroke-width="0"/><polyline points="50 50 90 50 90 90"/>',
        pen=False,
    ),
    "openfill": drawing(
        '<path d="M10 10H50V50" fill="#88f"/>'
        '<path d="M60 60H90V90" fill="#8f8" stroke="#000"/>'
        '<path d="M10 60H40V90" fill="none" stroke="#000"/>',
        pen=False,
    ),
    "currentcolor": drawing(
        '<g color="#0000"><path d="M10 10H90" stroke="currentColor"/></g><g color="#000">'
        '<path d="M10 20H90" stroke="currentColor"/></g>',
        pen=False,
    ),
    "gradient": drawing(
        '<linearGradient id="g"><stop offset="0" stop-color="#00f"/>'
        '<stop offset="1" stop-color="#008"/></linearGradient>'
        '<linearGradient id="h" xlink:href="#g"/><linearGradient id="e"/>'
        '<linearGradient id="t"><stop stop-opacity="0"/></linearGradient>'
        '<rect x="10" y="10" width="20" height="20" fill="url(#g)"/>'
        '<rect x="40" y="10" width="20" height="20" fill="url(#h)"/>'
        '<rect x="70" y="10" width="20" height="20" fill="url(#e)"/>'
        '<rect x="10" y="40" width="20" height="20" fill="url(#t)"/>'
        '<rect x="40" y="40" width="20" height="20" fill="url(#nope)"/>'
        '<rect x="70" y="40" width="20" height="20" fill="url(#nope) #00f"/>',
        pen=False,
    ),
    "invalid paint": drawing(
        "<style>path{stroke:#000;fill:none} .a{stroke:bogus;fill:notacolour}</style>"
        '<path class="a" d="M10 10H90V50"/>'
        '<path d="M10 60H90" stroke="#000" style="stroke:url(#q) nonsense"/>',
        pen=False,
    ),
    "csstransform": drawing(
        "<style>.r{transform:rotate(30deg);transform-origin:50px 50px}"
        ".t{transform:translate(20px,10%) scale(.5)}"
        ".u{transform:rotate(.1turn);transform-origin:center}.f{transform-box:fill-box;transfo"
        "rm-origin:center;transform:rotate(45deg)}</style><g>"
        '<rect class="r" x="40" y="40" width="20" height="20"/>'
        '<rect class="t" x="0" y="0" width="20" height="20"/><path class="u" d="M20 80H80"/>'
        '<rect class="f" x="70" y="10" width="20" height="20"/></g>',
    ),
    "origin attr": drawing(
        "<g>"
        '<rect transform="rotate(45)" transform-origin="80 20" x="70" y="10" width="20" '
        'height="20"/>'
        '<rect style="transform:scale(.5);transform-box:fill-box;transform-origin:right '
        'bottom" x="10" y="10" width="40" height="20"/>'
        '<g style="transform:skewX(10deg);transform-box:fill-box;transform-origin:0 100%">'
        '<rect x="20" y="50" width="20" height="20"/>'
        '<rect x="50" y="60" width="20" height="30"/></g></g>',
    ),
    "origin viewbox": drawing(
        "<g>"
        '<rect style="transform:rotate(30deg);transform-origin:50% 50%" x="-20" y="-20" '
        'width="40" height="40"/>'
        '<rect style="transform:rotate(10deg);transform-origin:top left" x="0" y="0" '
        'width="40" height="40"/></g>',
        page='width="100mm" height="100mm" viewBox="-50 -40 100 100"',
    ),
    "individual": drawing(
        '<g><rect style="translate:10px 20px" width="20" height="20"/>'
        '<rect style="rotate:30deg;transform-origin:60px 60px" x="50" y="50" width="20" '
        'height="20"/>'
        '<rect style="scale:2 1;translate:5px" x="10" y="70" width="20" height="20"/></g>',
    ),
    "css over attr": drawing(
        "<style>.a{transform:none}.b{transform:translate(10px)}</style><g>"
        '<rect class="a" transform="translate(40 40)" x="5" y="5" width="20" height="20"/>'
        '<rect class="b" transform="rotate(50)" x="50" y="5" width="20" height="20"/></g>',
    ),
    "switch": drawing(
        "<switch>"
        '<foreignObject requiredExtensions="http://ns.adobe.com/AdobeIllustrator/10.0/" '
        'width="1" height="1"/><g><path d="M10 10H90"/></g><path d="M10 20H90"/></switch>'
        '<switch><path systemLanguage="de" d="M10 30H90"/>'
        '<path systemLanguage="en" d="M10 40H90"/><path d="M10 50H90"/></switch>'
        '<path systemLanguage="fr" d="M10 60H90"/><path requiredExtensions="" d="M10 70H90"/>'
        '<path requiredFeatures="nonsense" d="M10 80H90"/>'
        '<path systemLanguage="" d="M10 90H90"/>',
    ),
    "nested": drawing(
        '<g><svg x="10" y="10" width="30" height="30" viewBox="0 0 10 10">'
        '<rect x="1" y="1" width="8" height="8"/></svg>'
        '<svg x="50" y="10" width="40" height="20" viewBox="0 0 10 10">'
        '<rect x="1" y="1" width="8" height="8"/></svg>'
        '<svg x="10" y="50" width="40" height="20" viewBox="0 0 10 10" '
        'preserveAspectRatio="xMinYMax slice"><rect x="1" y="1" width="8" height="8"/></svg>'
        '<svg x="60" y="50" width="30" height="40" viewBox="0 0 10 10" '
        'preserveAspectRatio="none"><rect x="1" y="1" width="8" height="8"/></svg></g>',
    ),
    "nested pct": drawing(
        '<g><svg x="10%" y="10%" width="50%" height="25%">'
        '<rect x="10%" y="10%" width="80%" height="80%"/></svg><svg y="50">'
        '<circle cx="50%" cy="25%" r="10%"/></svg></g>',
    ),
    "overflow": drawing(
        '<g><svg x="10" y="10" width="20" height="20"><path d="M5 5H60"/></svg>'
        '<svg x="10" y="40" width="20" height="20" overflow="visible"><path d="M5 5H60"/>'
        '</svg><svg x="10" y="70" width="20" height="20" style="overflow:auto">'
        '<path d="M5 5H60"/></svg></g>',
    ),
    "symbol": drawing(
        '<symbol id="s" viewBox="0 0 10 10"><path d="M1 1H9V9H1Z"/></symbol>'
        '<use href="#s" x="10" y="10" width="30" height="30"/>'
        '<use xlink:href="#s" x="50" y="10" width="40" height="20"/>'
        '<use href="#s" x="10" y="50" width="20" height="40"/>',
    ),
    "symbol par": drawing(
        '<symbol id="s" viewBox="0 0 10 10" preserveAspectRatio="xMaxYMin">'
        '<path d="M1 1H9V9H1Z"/></symbol>'
        '<symbol id="n" viewBox="0 0 10 10" preserveAspectRatio="none" overflow="visible">'
        '<path d="M1 1H12V9H1Z"/></symbol>'
        '<use href="#s" x="10" y="10" width="60" height="30"/>'
        '<use href="#n" x="10" y="50" width="60" height="20"/>',
    ),
    "symbol ref": drawing(
        '<symbol id="s" viewBox="0 0 10 10" refX="5" refY="5" width="40" height="40">'
        '<path d="M1 1H9V9H1Z"/></symbol><use href="#s" x="20" y="20"/>',
    ),
    "use svg": drawing(
        '<defs><svg id="s" width="20" height="20" viewBox="0 0 10 10"><path d="M1 1H9V9H1Z"/>'
        '</svg></defs><use href="#s" x="10" y="10"/>'
        '<use href="#s" x="40" y="10" width="40" height="40"/>',
    ),
    "use style": drawing(
        "<style>g path{stroke:#00f}.k{stroke:#000;fill:none}</style><defs>"
        '<path id="p" d="M0 0H30V10"/><g><path id="q" fill="none" d="M0 0H30V10"/></g></defs>'
        '<use href="#p" x="10" y="10" class="k"/><use href="#q" x="10" y="50"/>'
        '<use href="#p" x="50" y="50" visibility="hidden" class="k"/>',
        pen=False,
    ),
    "percent": drawing(
        '<rect x="10%" y="20%" width="50%" height="25%"/><circle cx="50%" cy="75%" r="10%"/>'
        '<line x1="5%" y1="5%" x2="95%" y2="10%"/>',
        page='width="100mm" height="50mm" viewBox="0 0 200 100"',
    ),
    "em": drawing(
        '<g font-size="10"><rect x="1em" y="1em" width="2em" height="2em"/>'
        '<g style="font-size:50%"><rect x="10em" y="1em" width="2em" height="2em"/></g>'
        '<g font-size="2em"><rect x="1em" y="2em" width="1rem" height="1em"/></g>'
        '<g style="font:bold 5px/1.2 Arial"><path d="M50 50h10"/>'
        '<rect x="12em" y="12em" width="2em" height="2em"/></g></g>',
    ),
    "units": drawing(
        '<g><rect x="1CM" y="10MM" width=".2IN" height="18PT"/>'
        '<rect x="60PX" y="1PC" width="10Q" height="1pc"/></g>',
    ),
    "rx": drawing(
        '<g><rect x="5" y="5" width="40" height="30" rx="10"/>'
        '<rect x="55" y="5" width="40" height="30" ry="10"/>'
        '<rect x="5" y="50" width="40" height="30" rx="30" ry="5"/>'
        '<rect x="55" y="50" width="40" height="30" rx="10" ry="0"/>'
        '<rect x="10" y="85" width="20" height="10" style="rx:auto" ry="3"/>'
        '<ellipse cx="60" cy="90" rx="8"/><ellipse cx="85" cy="90" ry="5"/></g>',
    ),
    "rx2": drawing(
        '<g><rect x="5" y="5" width="40" height="30" rx="-5" ry="5"/>'
        '<rect x="55" y="5" width="40" height="30" rx="10%"/>'
        '<rect x="5" y="50" width="40" height="30" rx="25%" ry="25%"/>'
        '<rect x="55" y="50" width="40" height="30" style="rx:5px;ry:10px"/></g>',
    ),
    "cssgeom": drawing(
        "<style>rect{x:10px;y:10%;width:30px;height:20px}circle{cx:70px;cy:30px;r:10px}path{d:"
        'path("M10 60H90V90")}</style><g><rect width="5" height="5"/><circle r="3"/>'
        '<path d="M0 0H5"/><ellipse cx="30" cy="50" style="rx:10px" ry="4"/></g>',
    ),
    "clip": drawing(
        '<clipPath id="c"><rect width="50" height="50"/></clipPath>'
        '<path clip-path="url(#c)" d="M-40 20H90V30H-40Z"/>',
    ),
    "clipfill": drawing(
        '<clipPath id="c"><circle cx="50" cy="50" r="30"/></clipPath>'
        '<rect clip-path="url(#c)" x="10" y="40" width="80" height="40" fill="#00f"/>',
        pen=False,
    ),
    "clipboth": drawing(
        '<clipPath id="c"><circle cx="50" cy="50" r="30"/></clipPath>'
        '<rect clip-path="url(#c)" x="10" y="40" width="80" height="40" fill="#88f" '
        'stroke="#000"/>',
        pen=False,
    ),
    "clipgroup": drawing(
        '<clipPath id="c"><path d="M10 10H90L50 90Z"/></clipPath><g clip-path="url(#c)">'
        '<path d="M0 30H100M0 60H100"/><circle cx="50" cy="40" r="35"/></g>',
    ),
    "clipbbox": drawing(
        '<clipPath id="c" clipPathUnits="objectBoundingBox"><rect width=".5" height="1"/>'
        '</clipPath><circle clip-path="url(#c)" cx="50" cy="50" r="30"/>'
        '<g clip-path="url(#c)"><path d="M10 5H90M10 95H90"/></g>',
    ),
    "cliprule": drawing(
        '<clipPath id="c"><path clip-rule="evenodd" d="M10 10H90V90H10ZM30 30H70V70H30Z"/>'
        '</clipPath><clipPath id="n"><path d="M10 10H90V90H10ZM30 30H70V70H30Z"/></clipPath>'
        '<path clip-path="url(#c)" d="M0 40H100"/><path clip-path="url(#n)" d="M0 60H100"/>',
    ),
    "clipclip": drawing(
        '<clipPath id="a"><rect x="20" width="60" height="100"/></clipPath>'
        '<clipPath id="c" clip-path="url(#a)"><circle cx="50" cy="50" r="40"/></clipPath>'
        '<path clip-path="url(#c)" d="M0 40H100M0 50H100"/><clipPath id="e"/>'
        '<path clip-path="url(#e)" d="M0 60H100"/>'
        '<path clip-path="url(#nope)" d="M0 95H100"/>',
    ),
    "clipchild": drawing(
        '<clipPath id="c" transform="translate(10 0)">'
        '<rect id="r" transform="rotate(10)" x="20" width="30" height="100"/>'
        '<circle cx="80" cy="80" r="10" display="none"/>'
        '<circle cx="80" cy="40" r="8" visibility="hidden"/><g>'
        '<circle cx="70" cy="20" r="5"/></g></clipPath>'
        '<path clip-path="url(#c)" d="M0 20H100M0 40H100M0 80H100"/>',
    ),
    "clipuse": drawing(
        '<defs><circle id="o" r="20"/></defs><clipPath id="c"><use href="#o" x="30" y="50"/>'
        '<use href="#o" x="60" y="50"/></clipPath>'
        '<path clip-path="url(#c)" d="M0 45H100M0 60H100"/>',
    ),
    "clipmoved": drawing(
        '<clipPath id="c"><rect x="10" y="10" width="30" height="30"/></clipPath>'
        '<g transform="translate(40 40) rotate(20)" clip-path="url(#c)">'
        '<path d="M0 25H100M0 35H100"/></g><g clip-path="url(#c)">'
        '<path transform="scale(2)" d="M0 10H100"/></g>',
    ),
    "clipcss": drawing(
        '<style>.c{clip-path:url("#c")}</style><clipPath id="c">'
        '<rect width="50" height="50"/></clipPath><path class="c" d="M10 20H90V30H10Z"/>',
    ),
    "background": drawing(
        '<rect width="100%" height="100%" fill="#fff"/>'
        '<path fill="none" stroke="#000" d="M10 10H90V90H10Z"/>',
        pen=False,
    ),
    "background2": drawing(
        '<g transform="translate(-5 -5)"><path fill="#fff" d="M0 0H110V110H0z"/></g>'
        '<path fill="none" stroke="#000" d="M10 10H90V90H10Z"/>',
        pen=False,
    ),
    "beyond": drawing(
        '<g><path d="M10 10H190"/><path d="M110 20H190"/>'
        '<rect x="80" y="50" width="50" height="20" fill="#00f"/></g>',
    ),
    "root transform": drawing(
        '<rect x="10" y="10" width="60" height="30"/>',
        page='width="100mm" height="100mm" viewBox="0 0 100 100" transform="rotate(20)"',
    ),
    "root transform css": drawing(
        '<rect x="10" y="10" width="60" height="30"/>',
        page='width="100mm" height="100mm" viewBox="0 0 100 100" style="transform:scale(.5)"',
    ),
    "vars": drawing(
        "<style>:root{--ink:#000;--none:none}.a{stroke:var(--ink);fill:var(--none)}.b{stroke:v"
        "ar(--gone,#000);fill:var(--gone, none)}.c{stroke:var(--gone)}</style>"
        '<path class="a" d="M10 10H90V40"/><path class="b" d="M10 50H90V60"/>'
        '<path class="c" fill="none" d="M10 70H90"/>',
        pen=False,
    ),
    "inherit": drawing(
        "<style>.p{stroke:#000;fill:none}.i{opacity:inherit;stroke:inherit}.n{stroke:initial}."
        'u{stroke:unset;fill:unset}</style><g class="p"><path class="i" d="M10 10H90"/>'
        '<path class="n" d="M10 20H90"/><path class="u" d="M10 30H90V50"/></g>',
        pen=False,
    ),
    "arcs": drawing(
        '<g><path d="M10 30a20 20 0 0140 0a20 20 0 11-40 0"/>'
        '<path d="M60 20q10-20 20 0t10 10"/><path d="m10 70l10-10 10 10-10 10zm40 0h20v20z"/>'
        '<path d="M60 60C60 40 90 40 90 60S70 90 95 95"/></g>',
    ),
    "fillrule": drawing(
        '<clipPath id="c"><rect width="60" height="100"/></clipPath>'
        '<path clip-path="url(#c)" fill="#00f" fill-rule="evenodd" d="M10 10H90V90H10ZM30 '
        '30H70V70H30Z"/>',
        pen=False,
    ),
    "selectors": drawing(
        "<style>g>path{stroke:#000}path:nth-child(2){stroke:none}[data-x]{stroke:#000}path:not"
        "(.k):last-child{stroke:none}.k+path{stroke:#00f !important}svg *{fill:none}</style>"
        '<g><path class="k" d="M10 10H90"/><path d="M10 20H90"/><path d="M10 30H90"/>'
        '<path data-x="1" d="M10 40H90"/><path d="M10 50H90"/></g>',
        pen=False,
    ),
    "style last": drawing(
        '<path class="a" d="M10 10H90V50"/><style type="text/css">'
        "<![CDATA[ .a{fill:none;stroke:#000} ]]></style>"
        '<style type="text/plain">.a{display:none}</style>'
        '<style media="print">.a{display:none}</style>',
        pen=False,
    ),
    "hidden def": drawing(
        '<defs><path id="p" d="M10 10H90"/></defs><marker id="m"><path d="M0 0H9"/></marker>'
        '<mask id="k"><rect width="9" height="9"/></mask><pattern id="q">'
        '<rect width="5" height="9"/></pattern><symbol><path d="M0 50H50"/></symbol>'
        '<path d="M10 60H90"/>',
    ),
    "display block": drawing(
        '<g style="display:block"><path d="M10 10H90"/></g><g display="bogus">'
        '<path d="M10 20H90"/></g><g style="display:none;display:bogus"><path d="M10 30H90"/>'
        "</g>",
    ),
    "scientific": drawing(
        '<polyline points="1e1,1e1 9e1,1e1 90,.5e2"/><polygon points="10 60,90 60,50 90"/>',
    ),
    "nested origin": drawing(
        '<svg x="20" y="20" width="60" height="60" viewBox="0 0 30 30">'
        '<rect style="transform-origin:50% 50%;transform:rotate(45deg)" x="10" y="10" '
        'width="10" height="10"/></svg>',
    ),
    "nested transform": drawing(
        '<svg x="20" y="20" width="40" height="40" viewBox="0 0 30 30" '
        'transform="rotate(15)"><rect x="2" y="2" width="20" height="20"/></svg>',
    ),
    "strokebox": drawing(
        '<rect style="transform-box:stroke-box;transform-origin:0 0;transform:rotate(20deg)" '
        'x="30" y="30" width="40" height="30" fill="none" stroke="#000" stroke-width="1"/>',
        pen=False,
    ),
    "capitals": drawing(
        "<style>.A{FILL:NONE;Stroke:#000}.B{DISPLAY:None}</style>"
        '<path class="A" d="M10 10H90V50"/><path class="A B" d="M10 60H90"/>'
        '<path fill="None" stroke="BLACK" d="M10 70H90"/>'
        '<path VISIBILITY="hidden" fill="none" stroke="black" d="M10 80H90"/>'
        '<path visibility="HIDDEN" stroke="black" d="M10 90H90"/>',
        pen=False,
    ),
    "comments in sheets": drawing(
        '<style><!-- .a{fill:none;stroke:#000} --></style><path class="a" d="M10 10H90V50"/>'
        '<defs><style>.b{stroke:#00f}</style></defs><path class="b" d="M10 60H90"/>',
        pen=False,
    ),
    "rules of names": drawing(
        '<style>/* x */@charset "utf-8";@namespace svg '
        "url(http://www.w3.org/2000/svg);svg|path{stroke:#000}path,;{stroke:none}</style>"
        '<path class="b" d="M10 60H90"/>',
        pen=False,
    ),
    "clip paths by name": drawing(
        '<clipPath id="c"><rect width="50" height="100"/></clipPath>'
        '<use href="#p" clip-path="url(#c)" y="20"/><path id="p" d="M10 10H90"/>'
        '<path clip-path="url(&quot;#c&quot;)" d="M10 50H90"/>'
        '<path style="clip-path: url( \'#c\' ) " d="M10 60H90"/>',
    ),
    "view boxes below 0": drawing(
        '<svg x="1cm" y="10%" width="5em" height="50%" viewBox="-10 -10 40 40">'
        '<rect width="50%" height="50%"/><circle cx="10" cy="10" r="10%"/></svg>',
    ),
    "shares in uses": drawing(
        '<defs><symbol id="s" viewBox="0 0 20 10" overflow="visible">'
        '<rect width="20" height="10"/></symbol></defs>'
        '<use href="#s" x="10%" y="10%" width="40%" height="40%"/>'
        '<use href="#s" x="50" y="60" width="40" height="5" transform="rotate(10 50 60)"/>'
        '<g transform="scale(.5)"><use href="#s" x="10" y="160" width="50" height="25"/></g>',
    ),
    "uses of uses": drawing(
        '<defs><g id="a"><rect width="8" height="8"/></g><g id="b"><use href="#a"/>'
        '<use href="#a" x="10"/></g></defs><use href="#b" x="10" y="10"/>'
        '<use href="#b" transform="translate(50 50) rotate(30)"/>',
    ),
    "stops that are clear": drawing(
        '<style>.s{stop-opacity:0}</style><radialGradient id="g"><stop class="s"/>'
        '<stop offset="1" style="stop-color:transparent"/></radialGradient>'
        '<rect x="10" y="10" width="30" height="30" fill="url(#g)"/>'
        '<rect x="50" y="50" width="30" height="30" fill="#00f"/>',
        pen=False,
    ),
    "background with a rim": drawing(
        '<rect width="100" height="100" fill="white" stroke="white"/><path d="M10 10H90V90"/>',
    ),
    "large radii": drawing(
        '<g><rect x="10" y="10" width="30" height="20" rx="50"/>'
        '<rect x="50" y="10" width="30" height="20" rx="50%" ry="2"/>'
        '<rect x="10" y="50" width="30" height="20" ry="50"/>'
        '<rect x="50" y="50" width="30" height="20" rx="0" ry="9"/></g>',
    ),
    "clipped fillings": drawing(
        '<clipPath id="c"><path d="M50 10L90 90H10Z"/></clipPath><g clip-path="url(#c)">'
        '<rect x="0" y="50" width="100" height="20" fill="#00f"/>'
        '<circle cx="50" cy="40" r="25"/></g>',
    ),
    "clipped along its edge": drawing(
        '<clipPath id="c"><rect x="20" y="20" width="50" height="50"/></clipPath>'
        '<rect clip-path="url(#c)" x="20" y="20" width="50" height="50" fill="#88f" '
        'stroke="#000"/><rect clip-path="url(#c)" x="30" y="20" width="10" height="20"/>',
    ),
    "cut by a viewport": drawing(
        '<svg x="10" y="10" width="50" height="50" viewBox="0 0 10 10">'
        '<circle cx="9" cy="5" r="3" fill="#00f"/></svg>',
        pen=False,
    ),
    "selectors of level 4": drawing(
        "<style>path:nth-of-type(2n){stroke:#000}g:has(circle) path{stroke:#00f}"
        "path:is(.a,.b){stroke:#080}:where(.c){stroke:#000}[class~=d]{stroke:#000}"
        '[id^="q"]{stroke:#000}</style><path d="M10 10H90"/><path d="M10 20H90"/><g><circle/>'
        '<path d="M10 30H90"/></g><path class="b" d="M10 40H90"/>'
        '<path class="c" d="M10 50H90"/><path class="x d" d="M10 60H90"/>'
        '<path id="q1" d="M10 70H90"/>',
        pen=False,
    ),
    "smooth curves 1": drawing(
        '<path d="M35 57zV39.60a20.64 6.64 1.19 112.03,-12.33a18.52 18.74 35.74 '
        "005.39,14.72ZT69.30 63.71H22.75m-18.29,11.20S47.82 67.51 80.31 "
        "67.13t-4.20,12.04A29.10 8.35 32.90 0049.59 30.64t11.16,14.21t0.29,-4.57q1.36,-3.70 "
        '-10.70,-6.53"/>',
    ),
    "smooth curves 2": drawing(
        '<path d="M44 61zh4.81ZS44.50 67.62 29.01 34.09S51.69 53.87 10.92 '
        "43.22m-7.40,-4.94m5.29,-17.60Q47.30 64.34 38.21 66.56a5.55 6.51 60.84 "
        "115.12,-8.05Q24.19 24.82 70.65 77.51S34.03 40.17 71.78 "
        '12.15m7.35,-14.74Zc6.15,-9.22 -6.89,7.12 5.98,-16.12"/>',
    ),
    "smooth curves 3": drawing(
        '<path d="M39 35L52.00 43.10h-6.35S87.76 53.28 74.92 14.91c-12.11,1.39 12.67,-13.15 '
        "11.67,16.87V75.88L49.00 55.67T13.99 31.71S59.45 51.57 14.08 35.85L78.56 "
        "72.02l-15.01,-17.26l14.18,-16.55Za12.90 12.86 31.62 11-5.57,-12.36Q44.30 20.21 "
        '10.28 67.84"/>',
    ),
}
