#!/bin/sh
# Random kills, in an empty folder. Usage: run_kills.sh GLINT WORK_FOLDER KILLS_PROGRAM [SEED]
"${0%/*}/../../tools/emptied" "$2" && rmdir "$2" || exit
exec "$3" "$1" "$2" 50 ${4:+"$4"}
