# Notes and folders
#
# $(call note,FILE,TEXT): the file's name; it holds the text, and is written where it is missing or holds another one.
# What depends on it is built anew where the text changes
same = $(and $(findstring <$1>,<$2>),$(findstring <$2>,<$1>))
noted = $(and $(wildcard $1),$(call same,$(strip $(file <$1)),$(strip $2)))
note = $(if $(call noted,$1,$2),,$(shell mkdir -p $(dir $1))$(file >$1,$2))$1
# $(folder): a line of a recipe that makes the target's folder where there is none: a process less for each object
folder = $(if $(wildcard $(@D)/.),,@mkdir -p $(@D))
