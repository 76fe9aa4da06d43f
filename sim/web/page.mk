# The page
#
# index.html: page/ and engine.wasm as one file

WEB_PAGE = $(wildcard sim/web/page/*) sim/web/engine.js sim/web/bundle.mjs
$(B)/web/index.html: $(B)/web/engine.wasm $(WEB_PAGE)
	@node sim/web/bundle.mjs $< $@
