# Packages
## package: zstrip for other build systems, into build/package: CMake, pkg-config, Debian, Arduino, PlatformIO,
##     ESP-IDF, pico-sdk
package: $(B)/.setup-package
	@sh firmware/package/make.sh $(B)
.PHONY: package
