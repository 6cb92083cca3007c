# Debian packages and a tree that can be moved: see tools/package.sh, which builds what this needs.
set(CPACK_PACKAGE_NAME obscura)
set(CPACK_PACKAGE_CONTACT "Obscura <obscura@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
