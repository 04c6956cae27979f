# Who publishes the program, and where: whoever does so sets it here. Packages and pages take it from here, and a test of
# the house (tests/house/project_test.cpp) compares CITATION.cff, which cannot. Empty: there is no such place, and nothing
# names one.
set(PROJECT_AUTHORS "The Isochron authors")
set(PROJECT_RELEASED 2026-11-30) # of the version in CMakeLists.txt
set(PROJECT_HOMEPAGE "")
set(PROJECT_CONTACT "") # an address of mail, also for faults of security
set(PROJECT_TRACKER "")
