#!/bin/sh
# Emacs' nXML mode validates against the compact syntax, as it does while one types.
. "$(dirname -- "$0")/lib.sh"
needs emacs
"$glint" schema rnc >glint.rnc
cat >validate.el <<'E'
(require 'nxml-mode)
(require 'rng-valid)
(defun count-errors (file)
  (with-current-buffer (find-file-noselect file)
    (let ((rng-nxml-auto-validate-flag nil))
      (nxml-mode)
      (rng-set-schema-file-1 (expand-file-name "glint.rnc"))
      (setq rng-current-schema-file-name (expand-file-name "glint.rnc"))
      (rng-validate-mode 1)
      (while (rng-do-some-validation))
      (princ (format "%s %s\n" (if (> (rng-compute-errors) 0) "bad" "good") file)))))
(defun rng-compute-errors () rng-error-count)
(setq enable-local-variables nil)
(dolist (file command-line-args-left) (count-errors file))
E
printf '<Scene glint="1"><Sphere radius="1"><Center x="0" y="0" z="0"/></Sphere></Scene>\n' >one.xml
printf '<Scene glint="1"><Sphere radius="0"><Center x="0" y="0" z="0"/></Sphere></Scene>\n' >two.xml
printf '<Scene glint="1"><Sphere radius="1"/></Scene>\n' >three.xml
cp "$source/scenes/showcase.glint.xml" four.xml
emacs --batch --quick -l validate.el one.xml two.xml three.xml four.xml >report 2>log || {
    cat log
    fail "emacs"
}
printf 'good one.xml\nbad two.xml\nbad three.xml\ngood four.xml\n' >wanted
cmp report wanted || {
    cat report log
    fail "verdicts"
}
