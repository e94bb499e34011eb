#!/bin/sh
# Random kills, in an empty folder. Usage: run_kills.sh GLINT WORK_FOLDER KILLS_PROGRAM [SEED]
rm -rf "$2"
exec "$3" "$1" "$2" 50 ${4:+"$4"}
